/// Values of one name for several bodies or pairs, told once where all are the same.
export class Gathered {
  #values = new Map();

  add(name, whose, value) {
    if (!this.#values.has(name)) this.#values.set(name, []);
    this.#values.get(name).push([whose, value]);
  }

  /// An object: {friction: 0.3} or {"friction[0]": 0.3, "friction[1]": 0.2}.
  settings() {
    const all = {};
    for (const [name, values] of this.#values) {
      if (values.every(([, value]) => value === values[0][1])) all[name] = values[0][1];
      else for (const [whose, value] of values) all[`${name}[${whose}]`] = value;
    }
    return all;
  }
}
