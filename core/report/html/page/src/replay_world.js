// The bodies of a replay in three dimensions. Lengths are in units of the largest radius or half edge.
import {
  AmbientLight, ArrowHelper, CircleGeometry, Color, DataTexture, DirectionalLight, Fog, Group,
  InstancedMesh, LinearFilter, LinearMipmapLinearFilter, Matrix4, Mesh, MeshBasicMaterial,
  MeshLambertMaterial, PerspectiveCamera, PlaneGeometry, RepeatWrapping, Scene, SphereGeometry,
  SRGBColorSpace, Vector3, WebGLRenderer,
} from 'three';
import { BodiesInSpace } from './bodies_in_space.js';
import { look_of } from './look.js';
import { SurfaceInSpace } from './surface_in_space.js';

const kMostArrows = 60;
const kMostMarks = 40;
const kCell = 2, kTiles = 300;  // of the substrate's grid: a cell [radii], cells across
const kWired = 40;     // [radii] from which on a wire would be but a blot
const kAhead = 0.03;  // [radii] that a ghost is larger, so that it shows where both coincide

/**
 * Draws into `canvas`; throws where there is no WebGL. `motion` is that of the page's data.
 * show() takes for the reference and the ghost (or null) lists of
 * {position, turn: [x, y, z, w], slip: [x, y] or null}, all SI.
 */
export class ReplayWorld {
  constructor(canvas, motion) {
    this.canvas = canvas;
    this.motion = motion;
    this.unit = Math.max(...motion.bodies.map(({ radius, shape }) => Math.max(radius, ...(shape?.size ?? []).map((x) => x / 2))));
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.camera = new PerspectiveCamera(38, 1, 0.05, 5000);
    this.camera.up.set(0, 0, 1);
    this.view = { azimuth: -0.9, height: 0.42, zoom: 1 };
    this.scene = new Scene();
    this.lab = new Group();
    this.lab.rotation.x = ((motion.tilt ?? 0) * Math.PI) / 180;  // downhill is -y
    this.scene.add(this.lab);
    this.target = new Vector3();
    this.span = 4;
    this.build();
  }

  build() {
    const count = this.motion.bodies.length;
    const bodies = (material, segments) => new BodiesInSpace(this.motion.bodies, this.unit, material, segments);
    const fine = count > 200 ? 16 : 40;
    this.pattern = octants();
    this.balls = bodies(new MeshLambertMaterial({ map: this.pattern }), fine);
    this.shell = bodies(new MeshLambertMaterial({ transparent: true, opacity: 0.28, depthWrite: false }), fine);
    this.wire = bodies(new MeshBasicMaterial({ wireframe: true, transparent: true, opacity: 0.75 }), 16);
    this.marks = new InstancedMesh(new SphereGeometry(1, 12, 8), new MeshBasicMaterial({ depthTest: false,
      transparent: true, opacity: 0.9 }), kMostMarks);
    const everything = [this.balls.meshes, this.shell.meshes, this.wire.meshes, this.marks].flat();
    if (this.motion.substrate) {
      this.shadows = new InstancedMesh(new CircleGeometry(1, 24), new MeshBasicMaterial({ color: 0x000000,
        transparent: true, opacity: 0.25, depthWrite: false }), count);
      this.ground = new Mesh(new PlaneGeometry(4000, 4000), new MeshBasicMaterial({ depthWrite: false }));
      this.tile = tile();
      this.tile.repeat.setScalar(kTiles);
      this.tile.anisotropy = this.renderer.capabilities.getMaxAnisotropy();
      this.grid = new Mesh(new PlaneGeometry(kTiles * kCell, kTiles * kCell), new MeshBasicMaterial({ alphaMap: this.tile,
        transparent: true, depthWrite: false }));
      this.ground.renderOrder = -3;
      this.grid.renderOrder = -2;
      this.shadows.renderOrder = -1;
      everything.push(this.shadows, this.ground, this.grid);
    }
    this.surfaces = (this.motion.surfaces ?? []).map((surface) => new SurfaceInSpace(surface, this.unit));
    everything.push(...this.surfaces.map((surface) => surface.mesh), ...this.surfaces.map(({ arrow }) => arrow).filter(Boolean));
    for (const mesh of everything) mesh.frustumCulled = false;
    this.lab.add(...everything);
    this.arrows = [];
    for (let k = 0; k < 2 * Math.min(count, kMostArrows); ++k) {
      const arrow = new ArrowHelper(new Vector3(1, 0, 0), new Vector3(), 1);
      arrow.visible = false;
      for (const part of [arrow.line, arrow.cone]) {
        part.material.depthTest = false;
        part.renderOrder = 3;
      }
      this.arrows.push(arrow);
      this.lab.add(arrow);
    }
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(-4, -6, 10);
    this.scene.add(sun, new AmbientLight(0xffffff, 1.3));
  }

  /** The page's colours, and that of the run for the ghost; null without one. */
  paint(colours, run) {
    const page = new Color(colours.card);
    this.scene.background = page.clone().lerp(new Color(colours.page), 0.5);
    this.scene.fog = new Fog(this.scene.background, 1, 1000);
    const ghost = new Color(run === null ? colours.faint : look_of(run.look).colour);
    // Bodies differ in tint; what is blue or orange elsewhere on the page are runs.
    this.balls.colour((k) => new Color().setHSL([0.58, 0.11, 0.42, 0.92, 0.0, 0.75][k % 6], 0.35, 0.62));
    this.shell.material.color.copy(ghost);
    this.wire.material.color.copy(ghost);
    this.marks.material.color.set('#e8b400');
    for (const { arrow } of this.surfaces) arrow?.setColor(new Color(colours.text));
    for (const { mesh } of this.surfaces) mesh.material.color.copy(page).lerp(new Color(colours.faint), 0.6);
    this.ground?.material.color.copy(page).lerp(new Color(colours.faint), 0.1);
    const half = this.arrows.length / 2;
    this.arrows.forEach((arrow, k) => arrow.setColor(k < half ? new Color(colours.truth) : ghost));
    this.grid?.material.color.set(colours.faint);
  }

  /** What the camera looks at and how much it must see, both [m]. */
  look_at(centre, span) {
    this.target.set(...centre.map((x) => x / this.unit));
    this.span = Math.max(4, span / this.unit);
  }

  show({ reference, ghost, marks, substrate, most_slip, time }) {
    for (const surface of this.surfaces) surface.place(time, this.target);
    this.balls.set(reference);
    for (const bodies of [this.shell, this.wire]) bodies.set(ghost ?? [], 1 + kAhead);
    this.set_marks(marks);
    const half = this.arrows.length / 2;
    this.set_arrows(this.arrows.slice(0, half), reference, most_slip);
    this.set_arrows(this.arrows.slice(half), ghost ?? [], most_slip);
    if (!this.motion.substrate) return this.draw();
    this.shadows.count = reference.length;
    reference.forEach(({ position: [x, y, z] }, k) => {
      const radius = this.motion.bodies[k].radius / this.unit;
      const wide = radius * Math.max(0.3, 0.95 - 0.25 * (z / this.unit - radius));
      this.shadows.setMatrixAt(k, new Matrix4().makeScale(wide, wide, 1)
        .setPosition(x / this.unit, y / this.unit, 0.002));
    });
    this.shadows.instanceMatrix.needsUpdate = true;
    // The grid goes with the substrate; it is never seen to end, since it follows the target in cells.
    const place = (at, moved) => moved + kCell * Math.round((at - moved) / kCell);
    const [sx, sy] = substrate.map((x) => x / this.unit);
    this.grid.position.set(place(this.target.x, sx), place(this.target.y, sy), 0);
    this.ground.position.set(this.target.x, this.target.y, -0.01);
    return this.draw();
  }

  set_marks(marks) {
    this.marks.count = Math.min(marks.length, kMostMarks);
    marks.slice(0, kMostMarks).forEach((point, k) => {
      this.marks.setMatrixAt(k, new Matrix4().makeScale(0.13, 0.13, 0.13)
        .setPosition(...point.map((x) => x / this.unit)));
    });
    this.marks.instanceMatrix.needsUpdate = true;
  }

  set_arrows(arrows, bodies, most_slip) {
    arrows.forEach((arrow, k) => {
      const body = bodies[k];
      const speed = body?.slip ? Math.hypot(...body.slip) : 0;
      arrow.visible = speed > 1e-3 * most_slip && most_slip > 0;
      if (!arrow.visible) return;
      const [x, y, z] = body.position.map((one) => one / this.unit);
      const length = 0.25 + 2.25 * (speed / most_slip);
      arrow.position.set(x, y, z - this.motion.bodies[k].radius / this.unit + 0.02);
      arrow.setDirection(new Vector3(body.slip[0], body.slip[1], body.slip[2] ?? 0).normalize());
      arrow.setLength(length, Math.min(0.5, 0.5 * length), Math.min(0.28, 0.3 * length));
    });
  }

  /** Turns the view [rad]; zoom > 1 comes nearer. */
  turn(azimuth, height, zoom = 1) {
    this.view.azimuth += azimuth;
    this.view.height = Math.min(1.5, Math.max(0.03, this.view.height + height));
    this.view.zoom = Math.min(20, Math.max(0.1, this.view.zoom * zoom));
    this.draw();
  }

  resize(width, height) {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    const { azimuth, height, zoom } = this.view;
    const narrow = Math.max(1, 1.5 / this.camera.aspect);
    const distance = (1.35 * this.span * narrow) / zoom;
    const target = this.target.clone().applyMatrix4(new Matrix4().makeRotationX(this.lab.rotation.x));
    this.camera.position.set(Math.cos(azimuth) * Math.cos(height), Math.sin(azimuth) * Math.cos(height),
      Math.sin(height)).multiplyScalar(distance).add(target);
    this.camera.lookAt(target);
    if (this.scene.fog) {
      this.scene.fog.near = 1.5 * distance;
      this.scene.fog.far = 5 * distance;
    }
    this.wire.visible = distance < kWired;
    this.renderer.render(this.scene, this.camera);
  }

  close() {
    this.scene.traverse((one) => {
      one.geometry?.dispose();
      one.material?.dispose();
    });
    this.pattern.dispose();
    this.tile?.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}

// A cell of the substrate's grid: a line around it.
function tile() {
  const size = 128, line = 2, data = new Uint8Array(4 * size * size).fill(255);
  for (let y = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x) {
      const far = Math.min(x, y, size - 1 - x, size - 1 - y) >= line;
      data.fill(far ? 0 : 110, 4 * (y * size + x), 4 * (y * size + x) + 3);
    }
  }
  const texture = smooth(new DataTexture(data, size, size));
  texture.wrapS = RepeatWrapping;
  texture.wrapT = RepeatWrapping;
  return texture;
}

// Eight octants, light and dark in turn, so that every rotation is seen.
function octants() {
  const width = 256, height = 128, data = new Uint8Array(4 * width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const dark = (Math.floor((4 * x) / width) + Math.floor((2 * y) / height)) % 2;
      data.set(dark ? [70, 70, 74, 255] : [255, 255, 255, 255], 4 * (y * width + x));
    }
  }
  const texture = new DataTexture(data, width, height);
  texture.colorSpace = SRGBColorSpace;
  return smooth(texture);
}

function smooth(texture) {
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return texture;
}
