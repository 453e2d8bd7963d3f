// The page: three views over one worker each for maps and for the rest, so that a large map holds up no slider.
import { OneCell } from "./cell.mjs";
import { Client } from "./client.mjs";
import { Maps } from "./maps.mjs";
import { Room } from "./room.mjs";
import { element } from "./parts.mjs";
import { unzipped } from "./unzipped.mjs";

element("unstarted").remove();
const tabs = [...document.querySelectorAll('[role="tab"]')];

new Maps(new Client());
const other = new Client();
const views = { "room-tab": new Room(other), "cell-tab": new OneCell(other) };

function choose(tab) {
  for (const each of tabs) {
    const is = each === tab;
    each.setAttribute("aria-selected", String(is));
    each.tabIndex = is ? 0 : -1;
    element(each.getAttribute("aria-controls")).hidden = !is;
  }
  views[tab.id]?.show();
}

for (const tab of tabs) {
  tab.addEventListener("click", () => choose(tab));
  tab.addEventListener("keydown", ({ key }) => {
    const steps = { ArrowRight: 1, ArrowLeft: -1 };
    if (!(key in steps)) return;
    const next = tabs[(tabs.indexOf(tab) + steps[key] + tabs.length) % tabs.length];
    choose(next);
    next.focus();
  });
}

element("licences").addEventListener("toggle", async () => {
  const text = unzipped(element("third-party").textContent).text();
  element("licences-text").textContent ||= await text.catch(({ message }) => message);
});
