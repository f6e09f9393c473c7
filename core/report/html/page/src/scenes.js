// Scenes are folded; what they show is made when they are opened for the first time.
import { add_figure } from './figure.js';
import { hide_runs } from './filter.js';
import { unpacked } from './motion.js';
import { add_replay } from './replay.js';
import { rove } from './rove.js';
import { make_sortable } from './sort.js';
import { add_time_chart } from './time_chart.js';

/** `view()` gives {filter, passes}: what is looked at now. */
export class Scenes {
  constructor(scenes, view, opened) {
    this.scenes = scenes;
    this.view = view;
    this.sections = new Map();
    for (const section of document.querySelectorAll('section.scene[data-scene]')) {
      const k = Number(section.dataset.scene), details = section.querySelector('details');
      this.sections.set(k, { section, details, is_filled: false });
      details.addEventListener('toggle', () => {
        if (!details.open) return;
        this.fill(k);
        opened(k);
      });
    }
  }

  fill(k) {
    const one = this.sections.get(k);
    if (one.is_filled) return;
    one.is_filled = true;
    const scene = this.scenes[k];
    const runs = one.section.querySelector('.runs');
    // The program's own HTML, escaped where it was made; the page's policy lets no script of it run.
    if (runs && scene.html) runs.innerHTML = scene.html;
    for (const table of one.section.querySelectorAll('table')) {
      make_sortable(table);
      rove(table);
    }
    hide_runs(this.view().filter, this.scenes, one.section);
    fill_plots(one.section.querySelector('.plots'), scene, this.view);
  }

  open(k, { scroll = true } = {}) {
    const one = this.sections.get(k);
    if (!one) return;
    one.details.open = true;
    this.fill(k);
    if (!scroll) return;
    one.section.scrollIntoView({ block: 'start' });
    one.details.querySelector('summary').focus({ preventScroll: true });
  }

  /** Those that the filter shows. */
  open_all(open) {
    for (const { section, details } of this.sections.values()) {
      if (!section.classList.contains('filtered')) details.open = open;
    }
  }
}

// The replay first, then phases, then time courses.
function fill_plots(parent, scene, view) {
  const has_motion = Boolean(scene.motion?.runs.length);
  let motions = null;  // unpacked when the first of them is looked at
  const unpack = () => {
    motions ??= scene.motion.runs.map((run) => unpacked(run, scene.motion.bodies)).sort((a, b) => a.run - b.run);
    return motions;
  };
  if (has_motion && scene.motion.runs.some((run) => run.run < 0)) add_replay(parent, scene, unpack);
  for (const chart of scene.charts) add_figure(parent, [chart], { runs: scene.runs, view });
  if (has_motion) add_time_chart(parent, scene, unpack, view);
}
