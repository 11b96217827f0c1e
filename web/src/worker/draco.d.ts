// The decoder of Draco's own package, as glTF-Transform takes it.
declare module 'draco3dgltf/draco_decoder_gltf_nodejs.js' {
  export default function createDecoder(options: { wasmBinary: ArrayBuffer }): Promise<object>;
}
