// What of MuJoCo can be set.

import { count, number, search, word } from '../../kit/settings.mjs';
import { unitSettings } from '../../kit/units.mjs';

export const SETTINGS = [
  word(
    'coefficients',
    ['fields', 'pair'],
    'pair',
    "the scene's coefficients straight in the geoms' fields, of which MuJoCo takes the larger; or exactly, " +
      'in a <pair> for each two bodies',
  ),
  word(
    'restitution',
    ['none', 'damping_ratio', 'one_step'],
    'damping_ratio',
    'how solref makes a rebound: not at all; by the damping ratio of a spring that has that e; by a damping ' +
      'that turns v into -e v in one step of Euler',
  ),
  number(
    'contact_steps',
    '',
    0,
    'duration of a rebound by damping_ratio, in steps; 0: as stiff as MuJoCo ships',
    { high: 1e4, ...search(2, 40, true) },
  ),
  number('overlap_push', '', 0.001, 'part of an overlap that one_step pushes out in a step', {
    high: 1,
    ...search(1e-4, 0.2, true),
  }),
  number(
    'slip_time',
    's',
    0,
    'time over which friction of one_step ends a slip; 0: one step, and tangential restitution',
    {
      high: 10,
      ...search(1e-3, 0.1, true),
    },
  ),
  number('time_constant', 's', 0.02, 'solref[0] of contacts that do not rebound', {
    low: 1e-9,
    high: 1e3,
    ...search(1e-3, 0.1, true),
  }),
  number('damping_ratio', '', 1, 'solref[1] of contacts that do not rebound', { low: 1e-3, high: 1e3 }),
  number('impedance_at_touch', '', 0.9, 'solimp[0]', {
    low: 1e-4,
    high: 0.9999,
    candidates: [0.9, 0.9999],
  }),
  number('impedance', '', 0.95, 'solimp[1], of overlaps beyond the width', {
    low: 1e-4,
    high: 0.9999,
    candidates: [0.95, 0.9999],
  }),
  number('impedance_width', 'm', 0.001, 'solimp[2], overlap over which the impedance changes'),
  number('margin', 'R', 0, 'gap at which there is a contact, over the smallest radius', {
    high: 1,
    candidates: [0, 1e-6, 1e-4],
  }),
  word(
    'cone',
    ['pyramidal', 'elliptic'],
    'pyramidal',
    'limit of friction and of rolling and drilling torque',
  ),
  word(
    'condim',
    ['by_need', '3', '4', '6'],
    'by_need',
    'rows of a contact: those that its coefficients need, or with friction (3), drilling (4), rolling friction (6)',
    { candidates: ['by_need'] },
  ),
  number('impratio', '', 1, 'impedance of friction over that of the normal force', {
    low: 1e-3,
    high: 1e6,
    candidates: [1, 10, 100],
  }),
  word('solver', ['PGS', 'CG', 'Newton'], 'Newton', 'of the constraints'),
  count('solver_iterations', 100, 'at most', { low: 1, high: 100_000, candidates: [1, 10, 100] }),
  count('line_search_iterations', 50, 'at most, of CG and Newton', { low: 1, high: 100_000 }),
  number('solver_tolerance', '', 1e-8, 'improvement at which the iterations end', {
    high: 1,
    candidates: [1e-8, 1e-14],
  }),
  count('noslip_iterations', 0, 'of a solver that goes over friction again', {
    high: 100_000,
    candidates: [0, 10],
  }),
  word('integrator', ['Euler', 'RK4', 'implicit', 'implicitfast'], 'Euler', 'of the motion'),
  ...unitSettings,
];
