// The words of the command on a page that has controls in the place of its options.

/** The control of each option that the page has, as its label says it. */
const CONTROLS = {
  semantics: "rules for ROS maps",
  mode: "mode of ROS maps",
  unknown: "grey or number that means unknown",
  encoding: "numbers of an array",
  resolution: "cell size of an array",
  submaps: "a row for each submap",
};

/** Returns a warning or a refusal of the command with the page's controls for the options in it. */
export function onPage(text) {
  let isControl = false;
  const option = /--(semantics|mode|unknown|encoding|resolution|submaps)\b(?: (nav2-humble|trinary|scale|raw|probability|percent|log-odds|mrpt|NaN|-?[\d.]*\d))?( (?=--))?/g;
  const changed = text.replace(option, (_, name, value, another) => {
    isControl = true;
    return `“${CONTROLS[name]}”${value ? `: ${value}` : ""}${another ? ", " : ""}`;
  });
  if (isControl) return `${changed} (see “How files are read”)`;
  return /--[a-z]/.test(text) ? `${text} (options of the command meaninfo, which this page has not)` : text;
}
