#!/usr/bin/env bash
# three.js 0.187.0 (npm): GLTFLoader gives wrong vertices for a valid file of interleaved vertices with a
# sparse accessor, and none for one whose last vertex ends with the buffer view.
#
# glTF lets a sparse accessor lie over any base, and a buffer view end with its last element, without
# that one's padding (byteStride * (count - 1) + its size). Khronos' validator has nothing against
# either file, and glTF Transform reads both right. GLTFLoader takes the interleaved floats of all
# attributes for positions, in silence: of 4 vertices with normals it makes 8, three of them normals, and
# the third and fourth are no longer where indices look for them. The other file, of 4 vertices that lie
# 32 bytes apart, is refused with a RangeError that names neither file nor accessor.
# So a morph target or an edited vertex over an interleaved mesh looks right in one reader and torn in
# the browser. Write such meshes unpacked; in a reader, unpack to one element after the other first.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
echo '{"type": "module"}' >package.json
npm install --silent --no-audit --no-fund --ignore-scripts --save-exact \
    three@0.187.0 @gltf-transform/core@4.5.1 gltf-validator@2.0.0-dev.3.10

cat >vertices.js <<'CODE'
import { NodeIO } from '@gltf-transform/core';
import validator from 'gltf-validator';
import { REVISION } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

globalThis.self = globalThis;  // a browser's name for it

// Of points whose attributes lie interleaved in one view, with the bytes that follow them.
function glb(view, position, others, bytes) {
    const views = [{ buffer: 0, byteOffset: 0, target: 34962, ...view }, ...others];
    const vertices = { bufferView: 0, componentType: 5126, count: 4, type: 'VEC3' };
    const json = {
        asset: { version: '2.0' },
        scene: 0,
        scenes: [{ nodes: [0] }],
        nodes: [{ mesh: 0 }],
        meshes: [{ primitives: [{ mode: 0, attributes: { POSITION: 0, NORMAL: 1 } }] }],
        buffers: [{ byteLength: bytes.length }],
        bufferViews: views,
        accessors: [{ ...vertices, ...position }, { ...vertices, byteOffset: 12 }],
    };
    const chunk = (type, data, filler) => {
        const padded = Buffer.concat([data, Buffer.alloc((4 - data.length % 4) % 4, filler)]);
        const head = Buffer.alloc(8);
        head.writeUInt32LE(padded.length, 0);
        head.write(type, 4, 'latin1');
        return Buffer.concat([head, padded]);
    };
    const body = Buffer.concat(
        [chunk('JSON', Buffer.from(JSON.stringify(json)), ' '), chunk('BIN\0', bytes, 0)]);
    const head = Buffer.alloc(12);
    head.write('glTF');
    head.writeUInt32LE(2, 4);
    head.writeUInt32LE(12 + body.length, 8);
    return new Uint8Array(Buffer.concat([head, body]));
}

// 4 vertices (1, 0, 100), (2, 10, 101) ... with the normal (0, 0, 1), so many floats apart.
function vertices(stride, end) {
    const floats = new Float32Array(end);
    for (let i = 0; i < 4; i++) floats.set([i + 1, 10 * i, 100 + i, 0, 0, 1], stride * i);
    return Buffer.from(floats.buffer);
}

async function read(name, file) {
    const report = await validator.validateBytes(file);
    const { numErrors, numWarnings } = report.issues;
    console.log(`${name}\n  validator       ${numErrors} errors, ${numWarnings} warnings`);
    const places = (count, element) =>
        Array.from({ length: count }, (_, i) => `(${element(i).join(' ')})`).join(' ');

    const document = await new NodeIO().readBinary(file);
    const plain = document.getRoot().listAccessors()[0];
    const stated = places(plain.getCount(), (i) => plain.getElement(i, []));
    console.log(`  glTF Transform  ${stated}`);

    let found;
    try {
        const { scene } = await new GLTFLoader().parseAsync(
            file.buffer.slice(file.byteOffset, file.byteOffset + file.length), '');
        const { position } = scene.children[0].geometry.attributes;
        found = places(position.count, (i) => [position.getX(i), position.getY(i), position.getZ(i)]);
    } catch (error) {
        found = String(error);
    }
    console.log(`  three.js ${REVISION}    ${found}`);
    return { valid: numErrors + numWarnings === 0, stated, found };
}

const sparse = await read('a sparse vertex over interleaved ones', glb(
    { byteLength: 96, byteStride: 24 },
    { min: [1, 0, 9], max: [7, 30, 103],
      sparse: { count: 1, indices: { bufferView: 1, componentType: 5121 }, values: { bufferView: 2 } } },
    [{ buffer: 0, byteOffset: 96, byteLength: 1 }, { buffer: 0, byteOffset: 100, byteLength: 12 }],
    Buffer.concat([vertices(6, 24), Buffer.from([1, 0, 0, 0]),
                   Buffer.from(new Float32Array([7, 8, 9]).buffer)])));
const ended = await read('a last vertex that ends with its view', glb(
    { byteLength: 120, byteStride: 32 }, { min: [1, 0, 100], max: [4, 30, 103] }, [], vertices(8, 30)));

const as_stated =
    sparse.valid && sparse.stated === '(1 0 100) (7 8 9) (3 20 102) (4 30 103)' &&
    sparse.found === '(1 0 100) (7 8 9) (2 10 101) (0 0 1) (3 20 102) (0 0 1) (4 30 103) (0 0 1)' &&
    ended.valid && ended.stated === '(1 0 100) (2 10 101) (3 20 102) (4 30 103)' &&
    ended.found === 'RangeError: Invalid typed array length: 32';
console.log(as_stated ? 'as stated' : 'NOT as stated: this finding is out of date');
process.exit(as_stated ? 0 : 1);
CODE
node vertices.js
