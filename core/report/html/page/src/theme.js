// Light or dark: the system's choice until the reader takes another.
import { make } from './dom.js';

const listeners = new Set();
const system = window.matchMedia('(prefers-color-scheme: dark)');

/** Calls `listener` whenever colours changed; returns a function that ends that. */
export function on_theme(listener) {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

let palette = {};

/** {blue: [on light, on dark], …} of the page's data. */
export function set_palette(colours) {
  palette = colours;
}

export function ink_colour(ink) {
  return palette[ink]?.[is_dark() ? 1 : 0];
}

export function is_dark() {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === 'dark' : system.matches;
}

/** The style sheet's colours as they are now: light-dark() is resolved where it is used, so one element uses them. */
export function theme_colours() {
  const probe = make('span', { hidden: true });
  document.body.append(probe);
  const colour = (name, otherwise) => {
    probe.style.color = otherwise;
    probe.style.color = `var(--${name}, ${otherwise})`;
    return hex_of(getComputedStyle(probe).color) ?? otherwise;
  };
  const colours = all_colours(colour);
  probe.remove();
  return colours;
}

/** "#0072b2" of "rgb(0, 114, 178)": charts append opacities to it. */
function hex_of(text) {
  const parts = /^rgb\((\d+), (\d+), (\d+)\)$/.exec(text);
  return parts && `#${parts.slice(1).map((part) => Number(part).toString(16).padStart(2, '0')).join('')}`;
}

function all_colours(colour) {
  return {
    text: colour('text', '#1b1b1b'),
    faint: colour('faint', '#5c5c5c'),
    page: colour('page', '#ffffff'),
    card: colour('card', '#f6f6f4'),
    line: colour('line', '#d5d5d0'),
    within: colour('within', '#0072b2'),
    deviates: colour('deviates', '#d55e00'),
    failed: colour('failed', '#cc79a7'),
    band: colour('band', '#0072b2'),
    truth: colour('truth', '#000000'),
  };
}

export function make_theme_button() {
  const button = make('button', { type: 'button', class: 'theme', onclick: toggle });
  const name = () => { button.textContent = is_dark() ? 'Light' : 'Dark'; };
  function toggle() {
    document.documentElement.dataset.theme = is_dark() ? 'light' : 'dark';
    remember(document.documentElement.dataset.theme);
    changed();
  }
  on_theme(name);
  name();
  return button;
}

/** Takes the choice of an earlier visit and follows the system's. */
export function start_theme() {
  try {
    const chosen = localStorage.getItem('slipcheck-theme');
    if (chosen === 'light' || chosen === 'dark') document.documentElement.dataset.theme = chosen;
  } catch { /* Storage may be forbidden to files. */ }
  system.addEventListener('change', changed);
}

function remember(theme) {
  try {
    localStorage.setItem('slipcheck-theme', theme);
  } catch { /* as above */ }
}

function changed() {
  for (const listener of listeners) listener();
}
