// The picture that is saved: the map as it is seen, with titles and the scale.

const MARGIN = 24;
/** What the scale is in, and how far right of the scale this is written. */
const UNIT = "bits per cell";
const BEFORE_UNIT = 64;

/** Returns a PNG of a canvas under two lines of title, with the scale of these colours to its right. */
export function drawnPicture(map, [title, subtitle], colours) {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  context.font = "bold 20px sans-serif";
  const wide = (...texts) => Math.max(...texts.map((text) => context.measureText(text).width));
  const scale = 3 * MARGIN + BEFORE_UNIT + wide(UNIT);
  [canvas.width, canvas.height] = [Math.max(map.width + scale, wide(title, subtitle) + 2 * MARGIN), Math.max(map.height, 320) + 90];
  context.fillStyle = "#fff";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = "#000";
  context.font = "bold 20px sans-serif";
  context.fillText(title, MARGIN, 32);
  context.font = "16px sans-serif";
  context.fillText(subtitle, MARGIN, 56);
  context.drawImage(map, MARGIN, 70);
  paintScale(context, colours, map.width + 2 * MARGIN, 70, 200);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

function paintScale(context, colours, left, top, height) {
  const colour = (k) => `rgb(${colours.slice(3 * k, 3 * k + 3).join(" ")})`;
  for (let y = 0; y < height; y++) {
    context.fillStyle = colour(255 - Math.round((255 * y) / (height - 1)));
    context.fillRect(left, top + y, 22, 1);
  }
  context.fillStyle = colour(256);
  context.fillRect(left, top + height + 16, 22, 22);
  context.fillStyle = "#000";
  for (const bits of [0, 0.5, 1]) context.fillText(String(bits), left + 30, top + height * (1 - bits) + 6);
  context.fillText("unknown", left + 30, top + height + 33);
  context.fillText(UNIT, left + BEFORE_UNIT, top + height / 2 + 6);
}
