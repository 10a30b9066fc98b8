// SPDX-License-Identifier: BSD-3-Clause
import {
  DepthTexture, Mesh, OrthographicCamera, PlaneGeometry, Scene, ShaderMaterial, UnsignedIntType,
  Vector2, WebGLRenderTarget,
} from 'three';

const kVertex = `
varying vec2 at;
void main() {
  at = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

// Every pixel is darkened by how much nearer its neighbours are, in octaves of depth.
const kFragment = `
uniform sampler2D picture, depths;
uniform vec2 pixel;
uniform float near, far, strength;
varying vec2 at;
float octave(vec2 place) {
  float depth = texture2D(depths, place).x;
  return log2(near * far / (far - depth * (far - near)));
}
void main() {
  float own = octave(at), nearer = 0.0;
  for (int k = 0; k < 8; ++k) {
    float angle = 0.7853982 * float(k);
    nearer += max(0.0, own - octave(at + pixel * vec2(cos(angle), sin(angle))));
  }
  bool empty = texture2D(depths, at).x >= 1.0;
  float shade = empty ? 1.0 : exp(-strength * nearer / 8.0);
  gl_FragColor = vec4(texture2D(picture, at).rgb * shade, 1.0);
  #include <colorspace_fragment>
}`;

/** Eye-dome lighting: edges of depth are darkened, which makes a cloud without normals read
 * as surfaces (Boucheny, "Interactive scientific visualization of large datasets", 2009). */
export class EyeDomeLighting {
  constructor() {
    this.target = new WebGLRenderTarget(1, 1, {samples: 4});
    this.target.depthTexture = new DepthTexture(1, 1, UnsignedIntType);
    this.material = new ShaderMaterial({
      vertexShader: kVertex,
      fragmentShader: kFragment,
      depthTest: false,
      depthWrite: false,
      uniforms: {
        picture: {value: this.target.texture},
        depths: {value: this.target.depthTexture},
        pixel: {value: new Vector2()},
        near: {value: 1},
        far: {value: 2},
        strength: {value: 14},
      },
    });
    this.camera = new OrthographicCamera();
    this.scene = new Scene();
    const quad = new Mesh(new PlaneGeometry(2, 2), this.material);
    quad.frustumCulled = false;
    this.scene.add(quad);
  }

  render(renderer, scene, camera) {
    const size = renderer.getDrawingBufferSize(new Vector2());
    this.target.setSize(size.x, size.y);
    const {pixel, near, far} = this.material.uniforms;
    const reach = 1.2 * renderer.getPixelRatio(); // [px]
    pixel.value.set(reach / size.x, reach / size.y);
    near.value = camera.near;
    far.value = camera.far;
    renderer.setRenderTarget(this.target);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.render(this.scene, this.camera);
  }
}
