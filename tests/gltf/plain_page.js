// A page as anybody would write it with three.js: GLTFLoader, DRACOLoader, the box in the middle.

import * as three from 'three';
import {DRACOLoader} from 'three/examples/jsm/loaders/DRACOLoader.js';
import {GLTFLoader} from 'three/examples/jsm/loaders/GLTFLoader.js';

const renderer = new three.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
renderer.setSize(window.innerWidth, window.innerHeight);
renderer.setClearColor(0xeef1f5);
document.body.append(renderer.domElement);
const scene = new three.Scene();
scene.add(new three.HemisphereLight(0xffffff, 0x555555, 3));
const loader = new GLTFLoader().setDRACOLoader(new DRACOLoader().setDecoderPath('/draco/'));

loader.loadAsync(new URLSearchParams(window.location.search).get('file')).then((gltf) => {
  scene.add(gltf.scene);
  const box = new three.Box3().setFromObject(gltf.scene);
  gltf.scene.position.sub(box.getCenter(new three.Vector3()));
  const size = box.getSize(new three.Vector3());
  const camera = new three.PerspectiveCamera(30, window.innerWidth / window.innerHeight,
    size.length() / 100, 100 * size.length());
  camera.position.set(0, 0, 3 * size.y);
  renderer.render(scene, camera);
  window.difmesh = {camera, size: size.toArray()};
  document.body.dataset.state = 'ready';
}).catch((error) => {
  document.body.dataset.state = 'failed';
  throw error;
});
