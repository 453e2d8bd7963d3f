#!/usr/bin/env bash
# Builds the page in a browser: `bindings/web/build.sh` writes meaninfo.wasm and meaninfo.html to target/web.
#
# A compiler that has the target is used as it is; rustup adds it: rustup target add wasm32-unknown-unknown. Otherwise Debian's
# rustc-web and the sources of its standard library are unpacked to target/web/toolchain, where they disturb nobody, and linked
# by the rust-lld of the compiler at hand. Where neither can be had, the status is 3.
set -euo pipefail
cd "$(dirname "$0")/../.."
target=${CARGO_TARGET_DIR:-target}
case $target in /*) ;; *) target=$PWD/$target ;; esac
out=$target/web
triple=wasm32-unknown-unknown
mkdir -p "$out"

no_toolchain() { echo "skipped: $1" >&2; exit 3; }

# Debian's compiler, where there is none yet or another version is to be had.
unpack() {
  local folder=$out/toolchain packages=(rustc-web rust-web-src) wanted
  command -v apt-get >/dev/null && command -v dpkg >/dev/null || return 1
  wanted=$(apt-cache policy rustc-web | sed -n 's/ *Candidate: //p')
  case $wanted in "" | "(none)") return 1 ;; esac
  [ "$(cat "$folder/version" 2>/dev/null)" = "$wanted" ] && return 0
  rm -rf "$folder" && mkdir -p "$folder/packages"
  # The libraries that it needs: its own, and LLVM's.
  packages+=(libstd-rust-web-dev)
  packages+=($(apt-cache depends libstd-rust-web-dev="$wanted" | sed -n 's/ *Depends: \(libstd-rust-web-.*\)/\1/p'))
  packages+=($(apt-cache depends "${packages[-1]}" | sed -n 's/ *Depends: \(libllvm.*\)/\1/p'))
  (cd "$folder/packages" && apt-get download -qq "${packages[@]}" >/dev/null 2>&1) || return 1
  for package in "$folder"/packages/*.deb; do dpkg -x "$package" "$folder" || return 1; done
  rm -r "$folder/packages"
  echo "$wanted" >"$folder/version"
}

arguments=(--release --target "$triple" --target-dir "$out" --manifest-path bindings/web/Cargo.toml --locked)
if [ -d "$(rustc --print sysroot)/lib/rustlib/$triple" ]; then
  cargo build "${arguments[@]}"
else
  lld=$(rustc --print sysroot)/lib/rustlib/$(rustc -vV | sed -n 's/host: //p')/bin/rust-lld
  [ -x "$lld" ] || no_toolchain "no $triple (rustup target add $triple), and no rust-lld"
  unpack || no_toolchain "no $triple (rustup target add $triple), and no packages rustc-web and rust-web-src"
  # Its libraries for it alone: cargo's own stay as they are.
  cat >"$out/toolchain/rustc" <<END
#!/bin/sh
LD_LIBRARY_PATH="$out/toolchain/usr/lib/x86_64-linux-gnu" exec "$out/toolchain/usr/bin/rustc" "\$@"
END
  chmod +x "$out/toolchain/rustc"
  RUSTC=$out/toolchain/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$lld \
    cargo build "${arguments[@]}" -Zbuild-std=std,panic_abort
fi
cp "$out/$triple/release/mean_information_web.wasm" "$out/meaninfo.wasm"
if command -v node >/dev/null; then node bindings/web/page.mjs "$out/meaninfo.wasm" "$out/meaninfo.html"; fi
