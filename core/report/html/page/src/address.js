// What is looked at stands in the address by name: #scene=symmetric-30cms&profile=tuned&verdict=deviates,failed.
import { empty_filter, kRunFields } from './filter.js';

const kFields = ['name', 'topic', ...kRunFields.map(([field]) => field)];

/** {filter, scene} of a location's hash; null where it is an anchor of the page. */
export function read_address(hash) {
  const text = hash.replace(/^#/, '');
  if (text && !text.includes('=')) return null;
  const values = new URLSearchParams(text);
  const filter = empty_filter();
  for (const field of kFields) filter[field] = values.get(field) ?? '';
  const verdicts = values.get('verdict');
  filter.verdicts = verdicts === null ? null : new Set(verdicts.split(',').filter(Boolean));
  return { filter, scene: values.get('scene') ?? '' };
}

/** The hash of what is looked at, "" where that is everything. */
export function write_address(filter, scene) {
  const values = [];
  const add = (name, value) => { if (value) values.push(`${name}=${encodeURIComponent(value).replaceAll('%20', '+').replaceAll('%2C', ',')}`); };
  add('scene', scene);
  for (const field of kFields) add(field, filter[field]);
  if (filter.verdicts) add('verdict', [...filter.verdicts].join(',') || 'none');
  return values.length ? `#${values.join('&')}` : '';
}
