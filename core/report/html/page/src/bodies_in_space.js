// The bodies of a replay, each kind drawn at once. Lengths are in units of the largest radius or half edge.
import {
  BoxGeometry, CylinderGeometry, InstancedMesh, Matrix4, Quaternion, SphereGeometry, Vector3,
} from 'three';

/** Of size 1 along each axis, a cylinder along x; spheres of radius 1, in so many segments. */
const kGeometries = {
  sphere: (segments) => new SphereGeometry(1, segments, Math.ceil(0.7 * segments)),
  block: () => new BoxGeometry(1, 1, 1),
  cylinder: (segments) => new CylinderGeometry(0.5, 0.5, 1, segments).rotateZ(Math.PI / 2),
};

const kind_of = ({ shape }) => shape?.kind ?? 'sphere';

/** `bodies` of the page's data, all of one material; set() places them. */
export class BodiesInSpace {
  constructor(bodies, unit, material, segments) {
    this.kinds = Object.keys(kGeometries)
      .map((kind) => ({ kind, which: bodies.flatMap((body, k) => (kind_of(body) === kind ? [k] : [])) }))
      .filter(({ which }) => which.length > 0)
      .map(({ kind, which }) => ({
        which, mesh: new InstancedMesh(kGeometries[kind](segments), material, which.length),
      }));
    this.meshes = this.kinds.map(({ mesh }) => mesh);
    this.material = material;
    this.forms = bodies.map(({ radius, shape }) => ({
      size: new Vector3(...(shape?.size ?? [radius, radius, radius]).map((x) => x / unit)),
      turn: new Quaternion(...(shape?.turn ?? [0, 0, 0, 1])),
    }));
    this.unit = unit;
  }

  /** As {position, turn: [x, y, z, w]} of each body, SI, so many times as large; an empty list hides them. */
  set(states, larger = 1) {
    const matrix = new Matrix4(), at = new Vector3(), turn = new Quaternion(), size = new Vector3();
    for (const { which, mesh } of this.kinds) {
      mesh.count = states.length === 0 ? 0 : which.length;
      if (states.length > 0) {
        which.forEach((k, place) => {
          at.set(...states[k].position.map((x) => x / this.unit));
          turn.set(...states[k].turn).multiply(this.forms[k].turn);
          mesh.setMatrixAt(place, matrix.compose(at, turn, size.copy(this.forms[k].size).multiplyScalar(larger)));
        });
      }
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  /** colour_of(k) for each body. */
  colour(colour_of) {
    for (const { which, mesh } of this.kinds) {
      which.forEach((k, place) => mesh.setColorAt(place, colour_of(k)));
      mesh.instanceColor.needsUpdate = true;
    }
  }

  set visible(shown) {
    for (const mesh of this.meshes) mesh.visible = shown;
  }
}
