// The page of `difmesh view`: one surface or two, from .glb files within the page.
//
// body.dataset.state is "ready" once the first picture is drawn, or "failed"; window.difmesh lets
// tests look at the camera.

import * as three from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {GLTFLoader} from 'three/examples/jsm/loaders/GLTFLoader.js';

const find = (id) => document.getElementById(id);
const scene = JSON.parse(find('scene').textContent);
const kBackground = 0xeef1f5;
const kPlain = new three.Color(0x9fb3c8);

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) {
    bytes[i] = text.charCodeAt(i);
  }
  return bytes.buffer;
}

/// A surface: a group of meshes that share a material, and the scalars of their vertices.
class Surface {
  constructor(name, root) {
    this.name = name;
    this.root = root;
    this.material = new three.MeshStandardMaterial(
      {side: three.DoubleSide, roughness: 0.6, metalness: 0, vertexColors: true});
    this.meshes = [];
    this.scalars = new Map();
    root.traverse((node) => {
      if (!node.isMesh) {
        return;
      }
      node.material = this.material;
      this.meshes.push(node);
      // Of a primitive among several the extras are with the parent.
      const extras = node.userData.difmesh ?? node.parent.userData.difmesh;
      for (const [semantic, facts] of Object.entries(extras?.scalars ?? {})) {
        this.scalars.set(facts.name, {...facts, attribute: semantic.toLowerCase()});
      }
      const count = node.geometry.attributes.position.count;
      const colors = new three.BufferAttribute(new Float32Array(3 * count), 3);
      node.geometry.setAttribute('color', colors);
    });
  }

  get triangles() {
    return this.meshes.reduce((sum, mesh) => sum + mesh.geometry.index.count / 3, 0);
  }

  paint(name, low, high, table) {
    const scalars = this.scalars.get(name);
    for (const mesh of this.meshes) {
      const colors = mesh.geometry.attributes.color;
      const values = scalars && mesh.geometry.attributes[scalars.attribute];
      for (let v = 0; v < colors.count; ++v) {
        let color = kPlain;
        if (values) {
          const share = high > low ? (values.getX(v) - low) / (high - low) : 0.5;
          color = table[Math.round(Math.min(Math.max(share, 0), 1) * (table.length - 1))];
        }
        colors.setXYZ(v, color.r, color.g, color.b);
      }
      colors.needsUpdate = true;
    }
  }
}

async function load() {
  const loader = new GLTFLoader();
  const surfaces = [];
  for (const {name, glb} of scene.surfaces) {
    surfaces.push(new Surface(name, (await loader.parseAsync(bytesOf(glb), '')).scene));
  }
  return surfaces;
}

class Viewer {
  constructor(surfaces) {
    this.surfaces = surfaces;
    this.shown = surfaces.length > 1 ? 'both' : '0';
    this.renderer = new three.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setClearColor(kBackground);
    document.body.prepend(this.renderer.domElement);
    this.camera = new three.PerspectiveCamera(30, 1, 0.1, 10);
    this.scene = new three.Scene();
    this.content = new three.Group();
    this.scene.add(this.content, this.camera, new three.HemisphereLight(0xffffff, 0x8c8f96, 2));
    const light = new three.DirectionalLight(0xffffff, 2);
    light.position.set(-1, 1, 1);
    this.camera.add(light);
    surfaces.forEach((surface) => this.content.add(surface.root));
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener('change', () => this.draw());
    window.addEventListener('resize', () => this.draw());
    this.centre();
  }

  /// The middle of all surfaces becomes zero: graphics cards have float32 only.
  centre() {
    const box = new three.Box3().setFromObject(this.content);
    const middle = box.getCenter(new three.Vector3());
    this.radius = box.getSize(new three.Vector3()).length() / 2 || 1;
    this.content.position.copy(middle).negate();
    const distance = 1.05 * this.radius / Math.sin(this.camera.fov * Math.PI / 360);
    this.camera.position.set(0.5, 0.35, 0.8).normalize().multiplyScalar(distance);
    this.camera.near = this.radius / 1000;
    this.camera.far = 100 * this.radius;
    this.controls.minDistance = this.radius / 100;
    this.controls.maxDistance = 50 * this.radius;
    this.controls.update();
  }

  draw() {
    const [width, height] = [window.innerWidth, window.innerHeight];
    this.renderer.setSize(width, height);
    this.renderer.setScissorTest(true);
    const both = this.shown === 'both';
    const part = both ? width / 2 : width;
    this.camera.aspect = part / height;
    this.camera.updateProjectionMatrix();
    const views = both ? [0, 1] : [Number(this.shown)];
    views.forEach((index, place) => {
      this.surfaces.forEach((surface, s) => { surface.root.visible = s === index; });
      this.renderer.setViewport(place * part, 0, part, height);
      this.renderer.setScissor(place * part, 0, part, height);
      this.renderer.render(this.scene, this.camera);
    });
    document.querySelectorAll('.name').forEach((label, s) => {
      label.hidden = !both;
      label.style.left = `${(s + 0.5) * part}px`;
    });
  }
}

/// Wires the panel to the viewer.
function addPanel(viewer) {
  const {surfaces} = viewer;
  const describe = (s) => `${s.name}: ${s.triangles.toLocaleString('en')} triangles`;
  find('facts').textContent = surfaces.map(describe).join(' · ');
  find('title').textContent = scene.title;
  document.title = `${scene.title} - difmesh`;
  find('layout').hidden = surfaces.length < 2;
  surfaces.forEach((surface, s) => {
    const label = document.createElement('label');
    const button = Object.assign(document.createElement('input'),
      {type: 'radio', name: 'shown', value: String(s)});
    label.append(button, ` ${surface.name}`);
    find('choices').append(label);
    const name = Object.assign(document.createElement('div'),
      {className: 'name', textContent: surface.name, hidden: true});
    document.body.append(name);
  });
  document.querySelectorAll('[name=shown]').forEach((button) => {
    button.checked = button.value === viewer.shown;
    button.addEventListener('change', () => {
      viewer.shown = button.value;
      viewer.draw();
    });
  });
  find('wireframe').addEventListener('change', (event) => {
    surfaces.forEach(({material}) => { material.wireframe = event.target.checked; });
    viewer.draw();
  });
  addColors(viewer);
}

function addColors(viewer) {
  const {surfaces} = viewer;
  const names = new Set(surfaces.flatMap((surface) => [...surface.scalars.keys()]));
  for (const name of names) {
    find('scalars').append(new Option(name, name));
  }
  const screen = scene.colors.map(([r, g, b]) => `rgb(${r},${g},${b})`);
  const table = screen.map((color) => new three.Color(color));
  const context = document.querySelector('#legend canvas').getContext('2d');
  for (let x = 0; x < 256; ++x) {
    context.fillStyle = screen[Math.round(x / 255 * (screen.length - 1))];
    context.fillRect(x, 0, 1, 1);
  }
  const paint = () => {
    const name = find('scalars').value;
    const [low, high] = [Number(find('low').value), Number(find('high').value)];
    surfaces.forEach((surface) => surface.paint(name, low, high, table));
    viewer.draw();
  };
  /// One range for both surfaces, so that they can be compared.
  const choose = () => {
    const name = find('scalars').value;
    find('legend').hidden = name === '';
    if (name === '') {
      paint();
      return;
    }
    const ranges = surfaces.map((s) => s.scalars.get(name)).filter((facts) => facts);
    let low = Math.min(...ranges.map((r) => r.low));
    let high = Math.max(...ranges.map((r) => r.high));
    if (scene.diverging) {
      high = Math.max(Math.abs(low), Math.abs(high));
      low = -high;
    }
    if (scene.range && name === scene.colorBy) {
      [low, high] = scene.range;
    }
    find('low').value = Number(low.toPrecision(4));
    find('high').value = Number(high.toPrecision(4));
    paint();
  };
  find('scalars').value = scene.colorBy ?? '';
  find('scalars').addEventListener('change', choose);
  find('low').addEventListener('change', paint);
  find('high').addEventListener('change', paint);
  choose();
}

load().then((surfaces) => {
  const viewer = new Viewer(surfaces);
  addPanel(viewer);
  window.difmesh = viewer;
  requestAnimationFrame(() => requestAnimationFrame(() => {
    document.body.dataset.state = 'ready';
  }));
}).catch((error) => {
  document.body.dataset.state = 'failed';
  find('facts').textContent = `The surface cannot be shown: ${error.message}`;
  throw error;
});
