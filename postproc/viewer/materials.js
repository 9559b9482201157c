// Shaders. All of them leave out what lies beyond the plane `cut`.

const kCutTest = "if (dot(place, cut.xyz) > cut.w) discard;";

function cutMaterial(uniforms, vertexShader, fragmentShader, options) {
  return new THREE.ShaderMaterial({uniforms, vertexShader, fragmentShader, ...options});
}

/** Faces with a headlight and light from above. `face` and `line`: opacity of faces and edges; the attribute `edge` gives
 * the distance from the three sides of a triangle. Where the cut opens a block, its inside shows in one flat colour, which
 * looks like the cut surface. */
function faceMaterial(shared, face, line, options) {
  return cutMaterial(
    {...shared, face: {value: face}, line: {value: line}},
    `attribute vec3 colour; attribute vec3 edge; varying vec3 place; varying vec3 colour_; varying vec3 edge_;
     void main() {
       place = position; colour_ = colour; edge_ = edge;
       gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
     }`,
    `uniform vec4 cut; uniform vec3 up; uniform vec3 inside; uniform vec3 ink; uniform float face; uniform float line;
     varying vec3 place; varying vec3 colour_; varying vec3 edge_;
     void main() {
       ${kCutTest}
       if (cut.w < 1e30 && !gl_FrontFacing) { gl_FragColor = vec4(inside, face); return; }
       vec3 eye = normalize(cameraPosition - place), n = normalize(cross(dFdx(place), dFdy(place)));
       n *= sign(dot(n, eye));
       float light = 0.42 + 0.40 * dot(n, eye) + 0.18 * (0.5 + 0.5 * dot(n, up));
       vec3 width = fwidth(edge_), far = edge_ / max(width, 1e-6);
       float tiny = max(width.x, max(width.y, width.z));  // of faces of few pixels no edges are drawn
       float near = (1.0 - smoothstep(0.3, 1.1, min(far.x, min(far.y, far.z)))) * (1.0 - smoothstep(0.25, 0.6, tiny));
       float alpha = mix(face, max(face, line), near);
       if (alpha < 0.01) discard;
       gl_FragColor = vec4(mix(colour_ * light, ink, near * (face < 1.0 ? 1.0 : line)), alpha);
     }`,
    options);
}

/** Rods and arrows: `span` times `scale` is their length in metres. The head is at most 5 thicknesses or 40 % long. */
function rodMaterial(shared, options) {
  return cutMaterial(
    {...shared, scale: {value: 1}, thickness: {value: 1}},
    `attribute vec3 span; attribute vec4 form; attribute vec3 colour; uniform float scale; uniform float thickness;
     varying vec3 place; varying vec3 colour_;
     void main() {
       float size = max(length(span) * scale, 1e-12); vec3 along = normalize(span);
       vec3 side = normalize(abs(along.z) < 0.9 ? vec3(-along.y, along.x, 0.0) : vec3(0.0, -along.z, along.y));
       float head = min(5.0 * thickness, 0.4 * size);
       float at = form.w > 0.5 ? size - head * (1.0 - form.z) : form.z * size;
       float thin = min(thickness, 0.08 * size + 0.15 * thickness);
       place = position;
       colour_ = colour;
       vec3 p = position + along * at + thin * (form.x * side + form.y * cross(along, side));
       gl_Position = projectionMatrix * viewMatrix * vec4(p, 1.0);
     }`,
    `uniform vec4 cut; varying vec3 place; varying vec3 colour_;
     void main() { ${kCutTest} gl_FragColor = vec4(colour_, 1.0); }`,
    {side: THREE.DoubleSide, ...options});
}

function bufferGeometry(attributes, index) {
  const geometry = new THREE.BufferGeometry();
  for (const [name, array, size, normalised] of attributes)
    geometry.setAttribute(name, new THREE.BufferAttribute(array, size, Boolean(normalised)));
  if (index) geometry.setIndex(new THREE.BufferAttribute(index, 1));
  return geometry;
}
