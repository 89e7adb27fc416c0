// The plan with what is done of it, what the partner's hand says, and at the end how this very person was understood.

import { element } from "./elements.js";
import { waitsShown } from "./waits.js";

/** Above this, a population stands for something that is so. */
const SURE = 0.5;

export class Plan {
  constructor(hello) {
    this.hello = hello;
    /** Of each subgoal: "done", "open", "later", or "spared" where another one was chosen. */
    this.states = hello.task.subgoals.map(() => "later");
    const items = hello.task.subgoals.map(({ name, side }) => element("li", `${name} \u2014 ${side === "person" ? "yours" : "the robot's"}`));
    document.getElementById("plan").replaceChildren(...items);
    const words = ({ grip, gesture, workspace, leads_to }) => {
      const part = workspace === "person" ? "a part of yours" : "a part of the robot's";
      return grip ? `taken from ${grip === "top" ? "above" : `the ${grip}`}, ${part}: ${leads_to}` : `${gesture}, over the middle of the table, for ${part}: ${leads_to}`;
    };
    const lines = hello.task.grasps.map(words);
    if (hello.task.pointing) lines.push(`a finger that points at a part of the ${hello.task.pointing.workspace}'s: ${hello.task.pointing.leads_to}`);
    document.getElementById("grasps").replaceChildren(...lines.map((line) => element("li", line)));
  }

  /** Takes in which subgoals stand as achieved. */
  show({ populations }) {
    const layer = this.hello.layers.find(({ name }) => name === "CSGL achieved");
    if (!layer) return;
    const items = document.getElementById("plan").children;
    const isDone = (index) => populations[3 * (layer.first + index)] > SURE;
    const isMade = ({ of, count }) => of.filter(isDone).length >= count;
    const { subgoals, choices } = this.hello.task;
    const isSpared = (index) => choices.some((choice) => choice.spares.includes(index) && isMade(choice));
    const isOpen = ({ after }) => after.subgoals.every(isDone) && after.choices.every((choice) => isMade(choices[choice]));
    subgoals.forEach((subgoal, index) => {
      const state = isDone(index) ? "done" : isSpared(index) ? "spared" : isOpen(subgoal) ? "open" : "later";
      this.states[index] = state;
      if (items[index].dataset.state !== state) items[index].dataset.state = state;
    });
  }

  /** What a population of a layer that stands is called, of several the one that has stood longest; null without one. */
  standing(name, { populations }) {
    const layer = this.hello.layers.find((own) => own.name === name);
    if (!layer) return null;
    let found = null, since = Infinity;
    for (let index = 0; index < layer.count; index += 1) {
      const stands = populations[3 * (layer.first + index) + 2];
      if (stands > 0 && stands < since) [found, since] = [layer.populations[index], stands];
    }
    return found;
  }
}

/** @param {string} layout "task", or "random:" and the number that gives the same places again */
export function layoutInWords(layout) {
  const seed = layout.split(":")[1];
  return seed === undefined ? "as in the task" : `shuffled, by the number ${seed}`;
}

/** The report of the person who has played. */
export function showReport(place, { at_ms, verdict, person, waits }) {
  if (!person) {
    place.replaceChildren(element("h2", "the run is over"), element("p", "It has left no report."));
    place.hidden = false;
    return;
  }
  const lead = known(person.median_lead_ms) ? `, ${Math.round(person.median_lead_ms)} ms before your grasp in the middle` : "";
  const answered = known(person.answered) ? `, ${person.answered} of them to be answered by the robot` : "";
  const lines = [
    `things done: ${person.actions}${answered}`,
    `${person.understood_before_grasp} understood before your grasp, ${person.rightly} rightly${lead}`,
    known(person.errors_noticed) && `errors noticed: ${person.errors_noticed}`,
    known(person.subgoals) && `${person.achieved} of ${person.subgoals} subgoals achieved`,
    known(person.assemblies) && `vehicles complete: ${person.assemblies}`,
    verdict?.work === "pass" ? "the work: as it should be" : `the work: ${verdict?.reasons?.join("; ") ?? "not judged"}`,
  ].filter(Boolean);
  const list = document.createElement("ul");
  list.append(...lines.map((line) => element("li", line)));
  place.replaceChildren(element("h2", "how you were understood"), list, ...(waits ? [waitsShown(waits, at_ms)] : []));
  place.hidden = false;
}

const known = (number) => Number.isFinite(number);

