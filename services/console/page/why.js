// Why a population stands or does not: a sentence, and what it gets from where, in numbers.

import { element } from "./elements.js";

/** @param {HTMLElement} place where it is told; `told` is the server's explanation, or null */
export function showWhy(place, told) {
  if (!told) {
    const hint = element("p", "Choose a population, and it says why it stands, or why it does not.");
    hint.className = "quiet";
    return place.replaceChildren(hint);
  }
  const most = Math.max(1, ...told.shares.map(({ amount }) => Math.abs(amount ?? 0)));
  const rows = told.shares.map((share) => {
    const row = document.createElement("tr");
    const amount = element("td", `${share.amount < 0 ? "\u2212" : "+"}${Math.abs(share.amount ?? 0).toFixed(2)}`);
    amount.className = "number";
    const bar = element("span", "");
    bar.className = share.amount < 0 ? "less" : "";
    bar.style.width = `${(50 * Math.abs(share.amount)) / most}%`;
    const balance = element("span", "");
    balance.className = "balance";
    balance.append(bar);
    const drawn = document.createElement("td");
    drawn.append(balance);
    const lacks = share.missing ? ` (lacks ${share.missing})` : "";
    row.append(amount, drawn, element("td", share.from + lacks), element("td", share.reason));
    return row;
  });
  const table = document.createElement("table");
  const head = document.createElement("tr");
  head.append(...["gets", "", "from", "because"].map((text) => element("th", text)));
  table.append(head, ...rows);
  place.replaceChildren(element("p", told.sentence), table);
}
