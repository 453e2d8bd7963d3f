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

/** What the command says of files of other names: it reads more than the page. */
const ALLOWED = /; allowed are \.yaml, .*\.pbstream$/;
const READ = "; read here are .yaml, .yml, .npy, .npz, .gridmap, .gridmap.gz, .ot, .bt, .pbstream and images";

/** The names of bags. */
export const BAG = /\.(bag|bag\.active|db3|mcap)$/i;

/** Returns what is said of a bag. */
export const ofBag = (name) => `${name}: is a bag, which the command reads: meaninfo map ${name} for its last map, meaninfo bag ${name} for all its maps`;

/** Returns a refusal of the command, `FILE: WHY`, in the page's words. */
export function refusalOnPage(text) {
  const [, file, why] = /^(.*?: )?(.*)$/s.exec(text);
  return `${file ?? ""}${onPage(why.replace(ALLOWED, READ))}`;
}

/** Returns a warning of the command with the page's controls for the options in it. */
export function onPage(text) {
  let isControl = false;
  const option = /(?<![\w-])--(semantics|mode|unknown|encoding|resolution|submaps)\b(?: (nav2-humble|trinary|scale|raw|probability|percent|log-odds|mrpt|NaN|-?[\d.]*\d))?( (?=--))?/g;
  const changed = text.replace(option, (_, name, value, another) => {
    isControl = true;
    return `“${CONTROLS[name]}”${value ? `: ${value}` : ""}${another ? ", " : ""}`;
  });
  if (isControl) return `${changed} (see “How files are read”)`;
  return /(?<![\w-])--[a-z]/.test(text) ? `${text} (options of the command meaninfo, which this page has not)` : text;
}
