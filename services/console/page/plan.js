// The plan with what is done of it, what the partner's hand says, and at the end how this very person was understood.

/** Above this, a population stands for something that is so. */
const SURE = 0.5;

export class Plan {
  constructor(hello) {
    this.hello = hello;
    this.achieved = hello.task.subgoals.map(() => false);
    const items = hello.task.subgoals.map(({ name, side }) => element("li", `${name} (${side === "person" ? "your side" : "the robot's side"})`));
    document.getElementById("plan").replaceChildren(...items);
    const words = ({ grip, gesture, workspace, leads_to }) => {
      const part = workspace === "person" ? "a part of yours" : "a part of the robot's";
      return grip ? `taken from ${grip === "top" ? "above" : `the ${grip}`}, ${part}: ${leads_to}` : `${gesture}, over the middle of the table, for ${part}: ${leads_to}`;
    };
    document.getElementById("grasps").replaceChildren(...hello.task.grasps.map((grasp) => element("li", words(grasp))));
  }

  /** Takes in which subgoals stand as achieved. */
  show({ populations }) {
    const layer = this.hello.layers.find(({ name }) => name === "CSGL achieved");
    const items = document.getElementById("plan").children;
    this.hello.task.subgoals.forEach(({ after }, index) => {
      const signal = populations[3 * (layer.first + index)];
      this.achieved[index] = signal > SURE;
      const open = !this.achieved[index] && after.every((before) => populations[3 * (layer.first + before)] > SURE);
      const state = this.achieved[index] ? "done" : open ? "open" : "later";
      if (items[index].dataset.state !== state) items[index].dataset.state = state;
    });
  }

  /** What a population of a layer that stands is called, of several the one that has stood longest; null without one. */
  standing(name, { populations }) {
    const layer = this.hello.layers.find((own) => own.name === name);
    let found = null, since = Infinity;
    for (let index = 0; index < layer.count; index += 1) {
      const stands = populations[3 * (layer.first + index) + 2];
      if (stands > 0 && stands < since) [found, since] = [layer.populations[index], stands];
    }
    return found;
  }
}

/** The report of the person who has played. */
export function showReport(place, { verdict, person }) {
  if (!person) {
    place.replaceChildren(element("h2", "the run is over"), element("p", "It has left no report."));
    place.hidden = false;
    return;
  }
  const lead = person.median_lead_ms === null ? "" : `, ${person.median_lead_ms} ms before your grasp in the middle`;
  const lines = [
    `${person.actions} things done, ${person.answered} of them to be answered by the robot`,
    `${person.understood_before_grasp} answered before your grasp, ${person.rightly} rightly${lead}`,
    `${person.errors_noticed} errors noticed`,
    `${person.achieved} of ${person.subgoals} subgoals achieved; ${person.assemblies} vehicles complete`,
    verdict?.work === "pass" ? "the work: as it should be" : `the work: ${verdict?.reasons?.join("; ") ?? "not judged"}`,
  ];
  const list = document.createElement("ul");
  list.append(...lines.map((line) => element("li", line)));
  place.replaceChildren(element("h2", "how you were understood"), list);
  place.hidden = false;
}

function element(name, text) {
  return Object.assign(document.createElement(name), { textContent: text });
}
