//! The inner loops that NumPy calls, and their table: the only file that speaks C, each `unsafe` with its reason.
#![allow(unsafe_code)]

use super::Elementwise;
use half::f16;
use mean_information::Real;
use num_traits::Zero;
use num_traits::float::FloatCore;
use numpy::npyffi::types::NPY_TYPES;
use numpy::npyffi::{PY_UFUNC_API, PyUFuncGenericFunction, npy_intp};
use numpy::{PyArrayDescr, PyArrayDescrMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use std::ffi::{c_char, c_int, c_void};
use std::hint::black_box;
use std::ptr;

/// The numbers that are computed at once, and those for which less memory is cleared.
const MANY: usize = 1024;
const FEW: usize = 16;
/// The numbers that are looked at side by side for NaN.
const LANES: usize = 16;

/// A number of an array, and the float that it is computed in.
trait Number: Copy {
    type Float: Real;
    /// Whether it is that float itself, so that bytes may be copied.
    const IS_FLOAT: bool;

    fn widened(self) -> Self::Float;
    fn rounded(x: Self::Float) -> Self;
}

impl<T: Real> Number for T {
    type Float = T;
    const IS_FLOAT: bool = true;

    fn widened(self) -> T {
        self
    }

    fn rounded(x: T) -> T {
        x
    }
}

/// A half, which is computed in single precision: rounded twice.
#[derive(Clone, Copy)]
#[repr(transparent)]
struct Half(f16);

impl Number for Half {
    type Float = f32;
    const IS_FLOAT: bool = false;

    fn widened(self) -> f32 {
        self.0.to_f32()
    }

    fn rounded(x: f32) -> Self {
        Self(f16::from_f32(x))
    }
}

/// Computes the function along two strided lists of numbers.
///
/// # Safety
/// As NumPy calls inner loops of one input and one output: `args` are their first numbers, `steps` the bytes from one number to
/// the next, `dimensions` their number; all are readable, and the output's writable.
unsafe extern "C" fn compute<F: Elementwise, N: Number>(
    args: *mut *mut c_char,
    dimensions: *mut npy_intp,
    steps: *mut npy_intp,
    _: *mut c_void,
) {
    // SAFETY: the caller's promise.
    let (count, [from, to], steps) = unsafe { (*dimensions, [*args, *args.add(1)], [*steps, *steps.add(1)]) };
    // SAFETY: the caller's promise, handed on.
    let is_invalid = unsafe {
        if count < FEW as npy_intp {
            along::<F, N, FEW>(from, to, steps, count)
        } else {
            along::<F, N, MANY>(from, to, steps, count)
        }
    };
    report(is_invalid);
}

/// Computes the function in pieces of `SIZE`. Returns whether a number lies outside its domain.
///
/// Numbers are copied to memory of our own and back: an output may be its own input, and arrays need not be aligned.
///
/// # Safety
/// There are `count` numbers at `from` and `to`, `steps` bytes apart, to read and to write.
unsafe fn along<F: Elementwise, N: Number, const SIZE: usize>(
    mut from: *const c_char,
    mut to: *mut c_char,
    [read, write]: [npy_intp; 2],
    count: npy_intp,
) -> bool {
    let (mut input, mut output) = ([N::Float::zero(); SIZE], [N::Float::zero(); SIZE]);
    let (mut left, mut is_invalid) = (count.max(0) as usize, false);
    while left > 0 {
        let size = left.min(SIZE);
        let (input, output) = (&mut input[..size], &mut output[..size]);
        // SAFETY: `size` numbers are left at `from`; the branch only lets the compiler know the distance.
        unsafe {
            if read == size_of::<N>() as npy_intp {
                gather::<N>(input, from, size_of::<N>() as npy_intp);
            } else {
                gather::<N>(input, from, read);
            }
        }
        F::apply(input, output);
        is_invalid |= has_nan(output) && input.iter().zip(&*output).any(|(x, y)| y.is_nan() && !x.is_nan());
        // SAFETY: as above, of `to`.
        unsafe {
            if write == size_of::<N>() as npy_intp {
                scatter::<N>(output, to, size_of::<N>() as npy_intp);
            } else {
                scatter::<N>(output, to, write);
            }
        }
        left -= size;
        // What follows the last number is never read.
        from = from.wrapping_offset(read.wrapping_mul(size as npy_intp));
        to = to.wrapping_offset(write.wrapping_mul(size as npy_intp));
    }
    is_invalid
}

/// Tells whether there is a NaN: in lanes without branches, since there is hardly ever one.
fn has_nan<T: Real>(numbers: &[T]) -> bool {
    let mut lanes = [false; LANES];
    let (rows, rest) = numbers.as_chunks::<LANES>();
    for row in rows {
        for (any, x) in lanes.iter_mut().zip(row) {
            *any |= x.is_nan();
        }
    }
    lanes.contains(&true) || rest.iter().any(|x| x.is_nan())
}

/// Reads numbers that stand `step` bytes apart.
///
/// # Safety
/// There are as many numbers at `from` as in `input`, aligned or not.
#[inline(always)]
unsafe fn gather<N: Number>(input: &mut [N::Float], from: *const c_char, step: npy_intp) {
    if N::IS_FLOAT && step == size_of::<N>() as npy_intp {
        // SAFETY: the caller's promise; numbers side by side are the bytes of as many floats, any of which are floats.
        unsafe { ptr::copy_nonoverlapping(from.cast(), input.as_mut_ptr().cast::<u8>(), size_of_val(input)) };
        return;
    }
    for (k, x) in input.iter_mut().enumerate() {
        let place = from.wrapping_offset(step.wrapping_mul(k as npy_intp)).cast::<N>();
        // SAFETY: the caller's promise. Another thread that writes meanwhile may leave any number here, all of which are allowed.
        *x = unsafe { ptr::read_unaligned(place) }.widened();
    }
}

/// Writes numbers `step` bytes apart.
///
/// # Safety
/// There is room for as many numbers at `to` as are in `output`, aligned or not.
#[inline(always)]
unsafe fn scatter<N: Number>(output: &[N::Float], to: *mut c_char, step: npy_intp) {
    if N::IS_FLOAT && step == size_of::<N>() as npy_intp {
        // SAFETY: as in `gather`.
        unsafe { ptr::copy_nonoverlapping(output.as_ptr().cast::<u8>(), to.cast(), size_of_val(output)) };
        return;
    }
    for (k, &x) in output.iter().enumerate() {
        let place = to.wrapping_offset(step.wrapping_mul(k as npy_intp)).cast::<N>();
        // SAFETY: the caller's promise.
        unsafe { ptr::write_unaligned(place, N::rounded(x)) };
    }
}

/// Leaves the floating-point exceptions as NumPy's own functions do: "invalid value" where a number lies outside the domain,
/// and none by which results were computed, as comparing the NaN of an unused place of a block is.
fn report(is_invalid: bool) {
    // SAFETY: NumPy's function takes nothing and clears the state of this thread's floating-point unit. The token stands for
    // looking the function up, which `add_to` did before there was a ufunc: it is read here, not written.
    unsafe { PY_UFUNC_API.PyUFunc_clearfperr(Python::assume_attached()) };
    if is_invalid {
        black_box(black_box(0.0_f64) / black_box(0.0_f64));
    }
}

/// Refuses integers and booleans.
unsafe extern "C" fn refuse<F: Elementwise>(
    _: *mut *mut c_char,
    _: *mut npy_intp,
    _: *mut npy_intp,
    _: *mut c_void,
) {
    let name = F::NAME.to_string_lossy();
    raise(format!(
        "{name}() takes floats: what integers and booleans mean is not known. Percentages (ROS) are measured by \
         tally(cells, encoding=\"percent\"), MRPT's bytes by tally(cells, encoding=\"mrpt\"); if the numbers are meant as \
         they are, {name}(cells.astype(float))"
    ));
}

/// Refuses floats of more digits than results have.
unsafe extern "C" fn refuse_long<F: Elementwise>(
    _: *mut *mut c_char,
    _: *mut npy_intp,
    _: *mut npy_intp,
    _: *mut c_void,
) {
    let name = F::NAME.to_string_lossy();
    raise(format!(
        "{name}() takes float64, float32 and float16, not longdouble: {name}(cells.astype(np.float64)) rounds the numbers first"
    ));
}

/// Leaves a `TypeError` behind: NumPy runs loops without the interpreter's lock, and looks for an exception after them.
fn raise(text: String) {
    Python::attach(|py| PyTypeError::new_err(text).restore(py));
}

/// The types whose loops refuse; they stand first, as NumPy takes the first loop that a type can be cast to.
const REFUSED: [NPY_TYPES; 11] = [
    NPY_TYPES::NPY_BOOL,
    NPY_TYPES::NPY_BYTE,
    NPY_TYPES::NPY_UBYTE,
    NPY_TYPES::NPY_SHORT,
    NPY_TYPES::NPY_USHORT,
    NPY_TYPES::NPY_INT,
    NPY_TYPES::NPY_UINT,
    NPY_TYPES::NPY_LONG,
    NPY_TYPES::NPY_ULONG,
    NPY_TYPES::NPY_LONGLONG,
    NPY_TYPES::NPY_ULONGLONG,
];
/// The loops that compute.
const COMPUTED: [NPY_TYPES; 3] = [NPY_TYPES::NPY_HALF, NPY_TYPES::NPY_FLOAT, NPY_TYPES::NPY_DOUBLE];
/// With that which refuses longdouble, the last: where it is as wide as a double, it is left out.
const LOOPS: usize = REFUSED.len() + COMPUTED.len() + 1;

/// Creates the ufunc and adds it to the module.
pub(super) fn add_to<F: Elementwise>(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    // SAFETY: NumPy's function takes nothing. Called here once, so that it is found when loops call it.
    unsafe { PY_UFUNC_API.PyUFunc_clearfperr(py) };
    let computed: [PyUFuncGenericFunction; 3] =
        [Some(compute::<F, Half>), Some(compute::<F, f32>), Some(compute::<F, f64>)];
    let mut functions = [Some(refuse::<F> as unsafe extern "C" fn(_, _, _, _)); LOOPS];
    functions[REFUSED.len()..LOOPS - 1].copy_from_slice(&computed);
    functions[LOOPS - 1] = Some(refuse_long::<F>);
    let is_longer = PyArrayDescr::new(py, "longdouble")?.itemsize() > size_of::<f64>();
    let refused = REFUSED.iter().map(|&from| [from, NPY_TYPES::NPY_DOUBLE]);
    let types: Vec<c_char> = refused
        .chain(COMPUTED.map(|float| [float, float]))
        .chain([[NPY_TYPES::NPY_LONGDOUBLE, NPY_TYPES::NPY_DOUBLE]])
        .flatten()
        .map(|number| number as c_char)
        .collect();
    // NumPy keeps the pointers as long as the ufunc lives, which is as long as the process: the memory is never freed.
    let functions = Box::leak(Box::new(functions)).as_mut_ptr();
    let types = types.leak().as_mut_ptr();
    let data = Box::leak(Box::new([ptr::null_mut::<c_void>(); LOOPS])).as_mut_ptr();
    let (name, doc) = (F::NAME.as_ptr(), F::DOC.as_ptr());
    let (none, unused): (c_int, c_int) = (-1, 0);
    // SAFETY: the tables have LOOPS entries, of types one for input and output each; names and docstrings are static. The
    // function returns a new reference, or null with an exception set. -1 is PyUFunc_None: no identity.
    let ufunc = unsafe {
        let ufunc = PY_UFUNC_API.PyUFunc_FromFuncAndData(
            py,
            functions,
            data,
            types,
            (LOOPS - usize::from(!is_longer)) as c_int,
            1,
            1,
            none,
            name,
            doc,
            unused,
        );
        Bound::from_owned_ptr_or_err(py, ufunc)?
    };
    module.add(&*F::NAME.to_string_lossy(), ufunc)
}
