/** What the labels' colours mean, and how much of the picture each has. */
import { LABEL_COLORS } from "./colors";
import type { Connection } from "./connection";
import { element, say } from "./dom";
import { segmentation_t } from "./messages";

const NAMES = new Map([[0, "obstacle"], [100, "wall"], [200, "accessible"], [50, "drop-off"], [255, "unknown"]]);

function key(label: number, name: string): HTMLElement {
  const entry = document.createElement("i");
  entry.className = "key";
  entry.style.setProperty("--c", LABEL_COLORS[label] ? `rgb(${LABEL_COLORS[label]})` : "var(--dim)");
  const share = document.createElement("b");
  share.id = `share_${label}`;
  entry.append(`${name} `, share);
  return entry;
}

export function followLabels(connection: Connection): void {
  const legend = element("labels_legend");
  const model = document.createElement("small");
  model.id = "labels_model";
  legend.replaceChildren(...[...NAMES].map(([label, name]) => key(label, name)), model);
  connection.on("SEGMENTS", segmentation_t, (m) => {
    m.class_label.forEach((label, i) => {
      if (!NAMES.has(label)) return;
      say(`share_${label}`, `${(100 * m.class_fraction_ratio[i]).toFixed(0)} %`);
    });
    say("labels_model", m.model);
    legend.dataset.wall = String(m.class_fraction_ratio[m.class_label.indexOf(100)] ?? 0);
  });
}
