// Who waited for whom, and when: two rows over the time of the run, each wait a bar in it.

import { element } from "./elements.js";

const ROWS = [["person", "you waited for the robot", "wait-person"], ["robot", "the robot waited for you", "wait-robot"]];

/**
 * @param {{person: object, robot: object}} waits of each: `seconds`, `spans_ms` and the `longest`
 * @param {number} until the run's last instant, ms
 */
export function waitsShown(waits, until) {
  const place = element("div", "");
  place.id = "waits";
  for (const [who, words, name] of ROWS) {
    const { seconds, spans_ms, longest } = waits[who];
    const bar = element("div", "", `bar ${name}`);
    bar.setAttribute("role", "img");
    bar.setAttribute("aria-label", `${words} ${spans_ms.length} times in ${(until / 1000).toFixed(0)} s`);
    bar.append(...spans_ms.map(([from, to]) => span(from, to, until)));
    place.append(element("p", `${words} ${seconds.toFixed(1)} s`), bar);
    if (longest.length > 0) place.append(element("p", `longest: ${longest.map(named).join(", ")}`, "quiet"));
  }
  return place;
}

function span(from, to, until) {
  const part = element("span", "");
  part.style.left = `${(100 * from) / until}%`;
  part.style.width = `max(2px, ${(100 * (to - from)) / until}%)`;
  part.title = `${(from / 1000).toFixed(1)} s to ${(to / 1000).toFixed(1)} s`;
  return part;
}

const named = ({ from_ms, seconds, subgoal }) => `${seconds.toFixed(1)} s at ${(from_ms / 1000).toFixed(0)} s${subgoal && ` for ${subgoal}`}`;
