// Judges the files of samples.cpp: the Khronos validator must find no error and no warning; what
// gltf-transform and draco3d decode must be the spheres of the formula, vertex by vertex.
//   node judge.mjs NPM-FOLDER SAMPLES

import {readFileSync, readdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';

const [npm, samples] = process.argv.slice(2);
const require = createRequire(join(npm, 'package.json'));
const load = (name) => import(pathToFileURL(require.resolve(name)).href);
const validator = require('gltf-validator');
const draco3d = require('draco3d');
const {NodeIO} = await load('@gltf-transform/core');
const {KHRDracoMeshCompression} = await load('@gltf-transform/extensions');

const decoder = await draco3d.createDecoderModule();
const io = new NodeIO()
  .registerExtensions([KHRDracoMeshCompression])
  .registerDependencies({'draco3d.decoder': decoder});

let checks = 0;
let failures = 0;
function check(truth, file, words) {
  ++checks;
  if (!truth) {
    ++failures;
    console.error(`${file}: ${words}`);
  }
}

async function validate(file) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(join(samples, file))),
    {uri: file, maxIssues: 20});
  const {numErrors, numWarnings, messages} = report.issues;
  check(numErrors === 0 && numWarnings === 0, file, JSON.stringify(messages));
  return report.info;
}

/// Position and normal of vertex v, which is the v-th of samples.cpp.
function truth(sample, v) {
  const around = 2 * sample.rows;
  const each = 2 + (sample.rows - 1) * around;
  const [ball, at] = [Math.floor(v / each), v % each];
  const row = at === 0 ? 0 : at === each - 1 ? sample.rows : 1 + Math.floor((at - 1) / around);
  const theta = Math.PI * row / sample.rows;
  const phi = 2 * Math.PI * ((at - 1) % around) / around;
  const normal = row === 0 ? [0, 0, 1] : row === sample.rows ? [0, 0, -1] :
    [Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta)];
  // Relative to the place: far from zero float64 has no digits left for differences.
  return {normal, position: normal.map((n, axis) =>
    sample.radius * n + (axis === 0 ? 4 * sample.radius * ball : 0))};
}

const difference = (a, b) => Math.max(...a.map((x, axis) => Math.abs(x - b[axis])));
const degrees = (a, b) => {
  const cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  return Math.atan2(Math.hypot(...cross), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 180 / Math.PI;
};

/// One primitive's vertices against the formula. `to` moves them to the place of the sample.
function compareVertices(sample, get, count, to, whole) {
  const extent = 2 * sample.radius * (2 * sample.spheres - 1);
  const bound = sample.error + 1e-9 * extent + (Math.hypot(...sample.place) > 0 ? 3e-10 : 0);
  const worst = {position: 0, normal: 0, height: 0, id: 0};
  for (let v = 0; v < count; ++v) {
    const id = get('_EDGE_ID', v);
    const number = id ? (id[0] + 65536 * (id[1] + 65536 * (id[2] + 65536 * id[3])) - 2 ** 40) / 3 :
      v;
    worst.id = Math.max(worst.id, Number.isInteger(number) ? 0 : 1);
    const wanted = truth(sample, number);
    const position = to(get('POSITION', v));
    worst.position = Math.max(worst.position, difference(position, wanted.position));
    whole.set(number, position);
    const normal = get('NORMAL', v);
    const height = get('_HEIGHT', v);
    worst.normal = Math.max(worst.normal, normal ? degrees(normal, wanted.normal) : 0);
    worst.height = Math.max(worst.height, height ? Math.abs(height[0] - wanted.position[2]) : 0);
  }
  const file = sample.file;
  check(worst.id === 0, file, 'an edge id is none that was written');
  check(worst.position <= bound, file, `positions off by ${worst.position}, not ${bound}`);
  const angle = sample.bits > 0 ? 0.25 : 1e-4;
  check(worst.normal < angle, file, `normals off by ${worst.normal} degrees, not ${angle}`);
  const step = sample.bits > 0 ? 2 * sample.radius / 4095 / 2 * 1.01 : 1e-6 * sample.radius;
  check(worst.height <= step + 3e-10, file, `heights off by ${worst.height}, not ${step}`);
}

/// Closed, and of the volume that the vertices of the formula enclose.
function compareSurface(sample, triangles, positionOf) {
  const edges = new Map();
  let [volume, wanted, area] = [0, 0, 0];
  const each = 2 + (sample.rows - 1) * 2 * sample.rows;
  const det = (a, b, c) => a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
  for (const corners of triangles) {
    volume += det(...corners.map(positionOf)) / 6;
    const [p, q, r] = corners.map((v) => truth(sample, v).position);
    wanted += det(p, q, r) / 6;
    const [u, w] = [q.map((x, i) => x - p[i]), r.map((x, i) => x - p[i])];
    area += Math.hypot(u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2],
      u[0] * w[1] - u[1] * w[0]) / 2;
    for (let c = 0; c < 3 && sample.rows < 200; ++c) {
      // Once in each sense: 1 and -1 add up to 0 on a closed surface.
      const [a, b] = [corners[c], corners[(c + 1) % 3]];
      const key = Math.min(a, b) * each * sample.spheres + Math.max(a, b);
      edges.set(key, (edges.get(key) ?? 0) + (a < b ? 1 : -1));
    }
  }
  const open = [...edges.values()].filter((sum) => sum !== 0).length;
  check(open === 0, sample.file, `${open} edges are open`);
  const exact = 4 / 3 * Math.PI * sample.radius ** 3 * sample.spheres;
  check(Math.abs(wanted - exact) < 0.01 * exact, sample.file, `the formula encloses ${wanted}`);
  const bound = Math.sqrt(3) * sample.error * area + 1e-6 * exact;
  check(Math.abs(volume - wanted) <= bound, sample.file,
    `volume off by ${volume - wanted}, not ${bound}`);
}

async function judgeGltf(sample) {
  const document = await io.read(join(samples, sample.file));
  const root = document.getRoot();
  const node = root.listNodes().find((n) => n.getMesh());
  const place = node.getTranslation();
  const local = place.map((x, axis) => x - sample.place[axis]);
  const parent = root.listNodes().find((n) => n !== node);
  if (sample.up === 'z' || sample.metres !== 1) {
    const size = sample.metres;
    check(difference(parent.getScale(), [size, size, size]) === 0, sample.file, 'the scale');
    // The matrix, column by column: z must become y.
    const matrix = parent.getMatrix();
    check(difference([...matrix.slice(8, 11)], [0, size, 0]) < 1e-9, sample.file, 'z is not up');
  } else {
    check(parent === undefined, sample.file, 'has a node too many');
  }
  const primitives = node.getMesh().listPrimitives();
  check(primitives.length === sample.primitives, sample.file, `${primitives.length} primitives`);
  const whole = new Map();
  const triangles = [];
  let [vertices, count] = [0, 0];
  for (const primitive of primitives) {
    const positions = primitive.getAttribute('POSITION');
    const arrays = new Map(['POSITION', 'NORMAL', '_EDGE_ID', '_HEIGHT', 'COLOR_0'].map(
      (name) => [name, primitive.getAttribute(name)]));
    const get = (name, v) => arrays.get(name)?.getElement(v, []);
    compareVertices(sample, get, positions.getCount(), (p) => p.map((x, axis) => x + local[axis]),
      whole);
    check((arrays.get('COLOR_0') !== null) === sample.color, sample.file, 'colors');
    const numbers = [];
    for (let v = 0; v < positions.getCount(); ++v) {
      const id = get('_EDGE_ID', v);
      numbers.push(id ? (id[0] + 65536 * (id[1] + 65536 * (id[2] + 65536 * id[3])) - 2 ** 40) / 3 :
        v);
    }
    const indices = primitive.getIndices().getArray();
    for (let i = 0; i < indices.length; i += 3) {
      triangles.push([numbers[indices[i]], numbers[indices[i + 1]], numbers[indices[i + 2]]]);
    }
    vertices += positions.getCount();
    count += indices.length / 3;
  }
  const each = 2 + (sample.rows - 1) * 2 * sample.rows;
  check(whole.size === each * sample.spheres, sample.file, `${whole.size} different vertices`);
  check(vertices === sample.vertices, sample.file, `${vertices} vertices`);
  check(count === sample.triangles, sample.file, `${count} triangles`);
  compareSurface(sample, triangles, (v) => whole.get(v));
}

/// A .drc file by Draco's own decoder.
function judgeDrc(sample) {
  const bytes = readFileSync(join(samples, sample.file));
  const buffer = new decoder.DecoderBuffer();
  buffer.Init(new Int8Array(bytes), bytes.length);
  const mesh = new decoder.Mesh();
  const reader = new decoder.Decoder();
  const status = reader.DecodeBufferToMesh(buffer, mesh);
  check(status.ok(), sample.file, status.error_msg());
  check(mesh.num_points() === sample.vertices && mesh.num_faces() === sample.triangles, sample.file,
    `${mesh.num_points()} points, ${mesh.num_faces()} faces`);
  const arrays = {POSITION: [reader.GetAttributeId(mesh, decoder.POSITION), 3],
    NORMAL: [reader.GetAttributeId(mesh, decoder.NORMAL), 3],
    _EDGE_ID: [reader.GetAttributeIdByMetadataEntry(mesh, 'name', '_EDGE_ID'), 4],
    _HEIGHT: [reader.GetAttributeIdByMetadataEntry(mesh, 'name', 'height'), 1]};
  const values = {};
  for (const [name, [id, width]] of Object.entries(arrays)) {
    const array = new decoder.DracoFloat32Array();
    reader.GetAttributeFloatForAllPoints(mesh, reader.GetAttribute(mesh, id), array);
    values[name] = [width, Array.from({length: array.size()}, (_, i) => array.GetValue(i))];
  }
  const get = (name, v) => values[name][1].slice(v * values[name][0], (v + 1) * values[name][0]);
  compareVertices(sample, get, mesh.num_points(), (p) => p, new Map());
}

const list = readFileSync(join(samples, 'samples.jsonl'), 'utf8').trim().split('\n')
  .map((line) => JSON.parse(line));
check(list.length >= 20, 'samples.jsonl', `${list.length} samples`);
for (const sample of list) {
  if (sample.file.endsWith('.drc')) {
    judgeDrc(sample);
    continue;
  }
  const info = await validate(sample.file);
  check(info.totalVertexCount === sample.vertices && info.totalTriangleCount === sample.triangles,
    sample.file, `the validator counts ${info.totalVertexCount}, ${info.totalTriangleCount}`);
  await judgeGltf(sample);
}
for (const file of ['triangle.glb', 'triangle_draco.glb']) {
  check((await validate(file)).totalTriangleCount === 1, file, 'is no triangle');
}
check(!readdirSync(samples).includes('empty.glb'), 'empty.glb', 'was written');

// A judge that accepts everything is none.
const broken = readFileSync(join(samples, 'plain.glb'));
broken.writeFloatLE(1e9, broken.length - 40 * 80 * 12 * 3);
const report = await validator.validateBytes(new Uint8Array(broken));
check(report.issues.numErrors > 0, 'plain.glb', 'is accepted with a changed number');

console.log(`${checks} checks of ${list.length + 2} files, ${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
