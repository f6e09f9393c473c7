// A surface of a scene in a replay: a plane, a plate, a rod or a ball, where it is at a time.
import { ArrowHelper, CylinderGeometry, DoubleSide, Mesh, MeshLambertMaterial, PlaneGeometry, Quaternion, SphereGeometry, Vector3 } from 'three';

const kPlaneSpan = 400;  // [units] across what stands for a plane

/** `surface` is that of the page's data, in SI; lengths of the mesh are in units of `unit` [m]. */
export class SurfaceInSpace {
  constructor(surface, unit) {
    this.surface = surface;
    this.unit = unit;
    const point = (values) => new Vector3(...values).divideScalar(unit);
    this.rest = { at: new Vector3(), turn: new Quaternion() };
    const { rest } = this;
    let geometry;
    if (surface.kind === 'plane') {
      geometry = new PlaneGeometry(kPlaneSpan, kPlaneSpan);
      this.normal = new Vector3(...surface.normal);
      rest.at = point(surface.point);
      rest.turn.setFromUnitVectors(new Vector3(0, 0, 1), this.normal);
    } else if (surface.kind === 'plate') {
      const length = point(surface.half_length), width = point(surface.half_width);
      geometry = new PlaneGeometry(2 * length.length(), 2 * width.length());
      rest.at = point(surface.centre);
      rest.turn = turn_to(length.clone().normalize(), width.clone().normalize());
    } else if (surface.kind === 'rod') {
      const begin = point(surface.begin), end = point(surface.end), axis = end.clone().sub(begin);
      geometry = new CylinderGeometry(surface.radius / unit, surface.radius / unit, axis.length(), 48);
      rest.at = begin.clone().add(end).multiplyScalar(0.5);
      rest.turn.setFromUnitVectors(new Vector3(0, 1, 0), axis.normalize());
    } else {
      geometry = new SphereGeometry(surface.radius / unit, 40, 28);
      rest.at = point(surface.centre);
    }
    this.mesh = new Mesh(geometry, new MeshLambertMaterial({ transparent: true, opacity: 0.35, side: DoubleSide,
      depthWrite: false }));
    this.mesh.renderOrder = -1;
    this.arrow = this.make_arrow();
  }

  /** Where its matter goes, of one that is moving: as long as a ball is wide. Null for one that stands or swings. */
  make_arrow() {
    const { belt, velocity, rate } = this.surface;
    const along = belt ?? velocity ?? rate;
    if (!along || !(Math.hypot(...along) > 0)) return null;
    const arrow = new ArrowHelper(new Vector3(...along).normalize(), new Vector3(), 2, 0x808080, 0.6, 0.35);
    for (const part of [arrow.line, arrow.cone]) {
      part.material.depthTest = false;
      part.renderOrder = 2;
    }
    return arrow;
  }

  /** Where it is at `time` [s]; what stands for a plane stays around `target`. */
  place(time, target) {
    const { surface, mesh, rest } = this;
    mesh.position.copy(rest.at);
    mesh.quaternion.copy(rest.turn);
    const move = (values, times) => mesh.position.addScaledVector(new Vector3(...values), times / this.unit);
    if (surface.velocity) move(surface.velocity, time);
    if (surface.amplitude)
      move(surface.amplitude, Math.sin(2 * Math.PI * surface.frequency * time + surface.phase));
    if (surface.rate) {
      const rate = new Vector3(...surface.rate);
      const turn = new Quaternion().setFromAxisAngle(rate.clone().normalize(), rate.length() * time);
      const about = new Vector3(...surface.about).divideScalar(this.unit);
      mesh.position.sub(about).applyQuaternion(turn).add(about);
      mesh.quaternion.premultiply(turn);
    }
    if (surface.kind === 'plane') {
      const off = target.clone().sub(mesh.position);
      mesh.position.add(off.addScaledVector(this.normal, -off.dot(this.normal)));
    }
    this.arrow?.position.copy(mesh.position);
  }
}

// The turn that takes x and y to two unit vectors at right angles.
function turn_to(first, second) {
  const along = new Quaternion().setFromUnitVectors(new Vector3(1, 0, 0), first);
  const y = new Vector3(0, 1, 0).applyQuaternion(along);
  return new Quaternion().setFromUnitVectors(y, second).multiply(along);
}
