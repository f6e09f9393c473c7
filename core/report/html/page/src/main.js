// Brings the page to life. Without this script it is complete, too: texts, tables and drawings.
import style from './style.css';
import { redraw_charts } from './chart.js';
import { read_data } from './data.js';
import { make } from './dom.js';
import { add_figure } from './figure.js';
import { apply_filter, make_filter_form, run_passes } from './filter.js';
import { unpacked } from './motion.js';
import { add_replay } from './replay.js';
import { make_sortable } from './sort.js';
import { make_theme_button, set_palette, start_theme } from './theme.js';
import { add_time_chart } from './time_chart.js';

const kSchema = 'slipcheck-page/2';

function plots(selector, fill) {
  for (const element of document.querySelectorAll(`.plots[data-${selector}]`)) {
    fill(element, Number(element.dataset[selector]));
  }
}

function fill_scene(parent, scene, passes) {
  if (scene.motion?.runs.length) {
    let motions = null;  // unpacked when the first of them is looked at: a page may hold hundreds
    const unpack = () => {
      motions ??= scene.motion.runs.map((run) => unpacked(run, scene.motion.bodies)).sort((a, b) => a.run - b.run);
      return motions;
    };
    if (scene.motion.runs.some((run) => run.run < 0)) add_replay(parent, scene, unpack);
    add_time_chart(parent, scene, unpack, passes);
  }
  for (const chart of scene.charts) add_figure(parent, [chart], (k) => passes(scene.runs[k]));
}

function fill_toolbar(scenes, changed) {
  const toolbar = document.getElementById('toolbar');
  if (!toolbar) return;
  if (scenes.length) {
    const total = `${scenes.length} scene${scenes.length === 1 ? '' : 's'}`;
    const { form, tell } = make_filter_form(scenes, (filter) => {
      tell(`${apply_filter(filter, scenes)} of ${total}`);
      changed(filter);
    });
    tell(`${scenes.length} of ${total}`);
    toolbar.append(form);
    for (const plain of document.querySelectorAll('fieldset.filter')) plain.remove();
  }
  toolbar.append(make_theme_button());
}

async function start() {
  document.head.append(make('style', {}, style));
  start_theme();
  for (const table of document.querySelectorAll('table')) make_sortable(table);
  const data = await read_data(document.getElementById('slipcheck-data'));
  const scenes = data?.scenes ?? [];
  let passes = () => true;
  fill_toolbar(scenes, (filter) => {
    passes = (run) => run_passes(filter, run);
    redraw_charts();
  });
  if (!data) return;
  if (data.schema !== kSchema) throw new Error(`data of the schema ${data.schema}, not ${kSchema}`);
  set_palette(data.palette);
  plots('scene', (parent, k) => fill_scene(parent, scenes[k], (run) => passes(run)));
  plots('engines', (parent) => add_figure(parent, data.engines));
  plots('precision', (parent, k) => { if (data.precision[k].charts.length) add_figure(parent, data.precision[k].charts); });
  plots('map', (parent, k) => add_figure(parent, [data.stability.maps[k]]));
  plots('limits', (parent, k) => add_figure(parent, [data.stability.limits[k]]));
  document.documentElement.dataset.ready = '';
}

start();
