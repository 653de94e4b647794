#pragma once

#include <ostream>

#include "tests/support/gltf_file.h"

namespace gazeloop::tests {

/// A triangle of which something is changed (RFC 7396), and what is said of it.
struct SpoiledFile {
    const char* name;
    const char* patch;
    const char* message;
};
inline void PrintTo(const SpoiledFile& at, std::ostream* out) { *out << at.name; }

inline GltfFile patched(const char* patch) {
    GltfFile file = one_triangle();
    file.document.merge_patch(nlohmann::json::parse(patch));
    return file;
}

/// Files that cannot be used.
inline const SpoiledFile kRefused[] = {
    SpoiledFile{"no_asset", R"({"asset": null})", "scene.gltf: lacks 'asset'"},
    SpoiledFile{"version_1", R"({"asset": {"version": "1.0"}})",
                "/asset/version: is \"1.0\": only"},
    SpoiledFile{"version_3", R"({"asset": {"version": "3.0"}})",
                "/asset/version: is \"3.0\": only"},
    SpoiledFile{"version_number", R"({"asset": {"version": 2.0}})", "/asset/version: is 2.0, must"},
    SpoiledFile{"min_version", R"({"asset": {"minVersion": "2.1"}})",
                "/asset/minVersion: asks for"},
    SpoiledFile{"no_scene", R"({"scenes": null, "scene": null})", "has no scene"},
    SpoiledFile{"draco",
                R"({"extensionsRequired": ["KHR_draco_mesh_compression"],
                    "extensionsUsed": ["KHR_draco_mesh_compression"]})",
                "/extensionsRequired/0: the file requires \"KHR_draco_mesh_compression\", which is "
                "not supported; export the scene without mesh compression"},
    SpoiledFile{"meshopt", R"({"extensionsRequired": ["EXT_meshopt_compression"]})",
                "requires \"EXT_meshopt_compression\""},
    SpoiledFile{"ktx2", R"({"extensionsRequired": ["KHR_texture_basisu"]})",
                "export its textures as PNG or JPEG"},
    SpoiledFile{"instancing", R"({"extensionsRequired": ["EXT_mesh_gpu_instancing"]})",
                "requires \"EXT_mesh_gpu_instancing\""},
    SpoiledFile{"mesh_index", R"({"nodes": [{"mesh": 1}]})",
                "/nodes/0/mesh: 1 is no index of meshes, of which there are 1"},
    SpoiledFile{"negative_index", R"({"nodes": [{"mesh": -1}]})", "/nodes/0/mesh: -1 is no index"},
    SpoiledFile{"half_an_index", R"({"nodes": [{"mesh": 0.5}]})", "/nodes/0/mesh: 0.5 is no index"},
    SpoiledFile{"word_for_index", R"({"nodes": [{"mesh": "0"}]})",
                "/nodes/0/mesh: is \"0\", must be a whole number"},
    SpoiledFile{"scene_index", R"({"scene": 4})", "/scene: 4 is no index of scenes"},
    SpoiledFile{"child_index", R"({"nodes": [{"children": [9]}]})", "/nodes/0/children/0: 9 is no"},
    SpoiledFile{"own_child", R"({"nodes": [{"mesh": 0}, {"children": [1]}]})",
                "/nodes/1/children/0: node is its own child"},
    SpoiledFile{"circle", R"({"nodes": [{"mesh": 0}, {"children": [2]}, {"children": [1]}]})",
                "is its own ancestor"},
    SpoiledFile{"two_parents",
                R"({"nodes": [{"children": [1, 2]}, {"children": [2]}, {"mesh": 0}]})",
                "/nodes/1/children/0: node 2 is a child of node 0 already"},
    SpoiledFile{"root_that_is_a_child",
                R"({"nodes": [{"children": [1]}, {"mesh": 0}], "scenes": [{"nodes": [0, 1]}]})",
                "/nodes/1: is listed by the scene, and is a child of node 0"},
    SpoiledFile{"root_twice", R"({"scenes": [{"nodes": [0, 0]}]})", "node 0 is listed twice"},
    SpoiledFile{"mode_9",
                R"({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 9}]}]})",
                "/meshes/0/primitives/0/mode: is 9, must be from 0 to 6"},
    SpoiledFile{"no_primitive", R"({"meshes": [{"primitives": []}]})",
                "/meshes/0/primitives: is a list of 0, must be a list that is not empty"},
    SpoiledFile{"accessor_past_its_view", R"({"accessors": [{"bufferView": 0, "byteOffset": 4,
                "componentType": 5126, "count": 3, "type": "VEC3"}]})",
                "/accessors/0: its 3 elements end at byte 40 of a view that has 36"},
    SpoiledFile{"count_of_2_to_the_53", R"({"accessors": [{"bufferView": 0,
                "componentType": 5126, "count": 9007199254740991, "type": "VEC3"}]})",
                "of a view that has 36"},
    SpoiledFile{"count_of_zeros", R"({"accessors": [{"componentType": 5126, "count": 900719925474,
                "type": "VEC3"}]})",
                "more than the"},
    SpoiledFile{"count_0", R"({"accessors": [{"bufferView": 0, "componentType": 5126, "count": 0,
                "type": "VEC3"}]})",
                "/accessors/0/count: is 0, must be from 1"},
    SpoiledFile{"component_type", R"({"accessors": [{"bufferView": 0, "componentType": 5130,
                "count": 3, "type": "VEC3"}]})",
                "/accessors/0/componentType: is 5130, must be one of"},
    SpoiledFile{"integers_of_32_bits", R"({"accessors": [{"bufferView": 0, "componentType": 5125,
                "count": 3, "type": "VEC3"}]})",
                "POSITION cannot be a VEC3 of 32-bit integers"},
    SpoiledFile{"element_type", R"({"accessors": [{"bufferView": 0, "componentType": 5126,
                "count": 3, "type": "VEC2"}]})",
                "/meshes/0/primitives/0/attributes/POSITION: POSITION cannot be a VEC2 of floats"},
    SpoiledFile{"view_past_its_buffer",
                R"({"bufferViews": [{"buffer": 0, "byteOffset": 1, "byteLength": 36}]})",
                "/bufferViews/0: bytes 1 to 37 are past the end of buffer 0, which has 36"},
    SpoiledFile{"small_stride",
                R"({"bufferViews": [{"buffer": 0, "byteLength": 36, "byteStride": 8}]})",
                "/accessors/0: its elements have 12 bytes, its view a byteStride of 8"},
    SpoiledFile{"stride_of_256",
                R"({"bufferViews": [{"buffer": 0, "byteLength": 36, "byteStride": 256}]})",
                "/bufferViews/0/byteStride: is 256, must be from 4 to 252"},
    SpoiledFile{"mat3_of_bytes_takes_12", R"({"accessors": [{"bufferView": 0, "componentType": 5126,
                "count": 3, "type": "VEC3"}, {"bufferView": 0, "componentType": 5121, "count": 4,
                "type": "MAT3"}]})",
                "/accessors/1: its 4 elements end at byte 48"},
    SpoiledFile{"counts_differ", R"({"accessors": [{"bufferView": 0, "componentType": 5126,
                "count": 3, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]}, {"bufferView": 0,
                "componentType": 5126, "count": 2, "type": "VEC3"}], "meshes": [{"primitives":
                [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}]})",
                "has 3 elements, NORMAL has 2"},
    SpoiledFile{"float_indices", R"({"meshes": [{"primitives": [{"attributes": {"POSITION": 0},
                "indices": 0}]}]})",
                "/meshes/0/primitives/0/indices: indices cannot be a VEC3 of floats"},
    SpoiledFile{"bounds", R"({"accessors": [{"bufferView": 0, "componentType": 5126,
                "count": 3, "type": "VEC3", "min": [0, 0]}]})",
                "/accessors/0/min: has 2 numbers, its elements have 3"},
    SpoiledFile{"colour_of_3", R"({"materials": [{"pbrMetallicRoughness":
                {"baseColorFactor": [1, 1, 1]}}]})",
                "/materials/0/pbrMetallicRoughness/baseColorFactor: is a list of 3, must be a list "
                "of 4 numbers"},
    SpoiledFile{"alpha_mode", R"({"materials": [{"alphaMode": "GLASS"}]})",
                "/materials/0/alphaMode: is \"GLASS\", must be one of OPAQUE, MASK, BLEND"},
    SpoiledFile{"roughness", R"({"materials": [{"pbrMetallicRoughness": {"roughnessFactor": 2}}]})",
                "roughnessFactor: is 2, must be at least 0 and at most 1"},
    SpoiledFile{"rotation_of_zero", R"({"nodes": [{"mesh": 0, "rotation": [0, 0, 0, 0]}]})",
                "/nodes/0/rotation: is zero"},
    SpoiledFile{"ior", R"({"materials": [{"extensions": {"KHR_materials_ior": {"ior": 0.5}}}],
                "extensionsUsed": ["KHR_materials_ior"]})",
                "/materials/0/extensions/KHR_materials_ior/ior: is 0.5, must be 0 or at least 1"},
    SpoiledFile{"projection", R"({"nodes": [{"mesh": 0, "matrix":
                [1,0,0,0, 0,1,0,0, 0,0,1,1, 0,0,0,1]}]})",
                "/nodes/0/matrix: its last row must be 0, 0, 0, 1"},
    SpoiledFile{"far_away", R"({"nodes": [{"translation": [3e38, 0, 0], "children": [1]},
                {"translation": [3e38, 0, 0], "mesh": 0}]})",
                "/nodes/1: lies or is scaled beyond what single precision holds"},
    SpoiledFile{"too_large_a_number", R"({"nodes": [{"mesh": 0, "translation": [1e39, 0, 0]}]})",
                "/nodes/0/translation/0: is 1e+39, must be"},
    SpoiledFile{"two_sources", R"({"images": [{"uri": "a.png", "bufferView": 0}]})",
                "/images/0: must have either 'uri' or 'bufferView'"},
    SpoiledFile{"spot_without_cone", R"({"extensions": {"KHR_lights_punctual":
                {"lights": [{"type": "spot"}]}}, "extensionsUsed": ["KHR_lights_punctual"]})",
                "/extensions/KHR_lights_punctual/lights/0: is a spot light and lacks 'spot'"},
    SpoiledFile{"cone_inside_out", R"({"extensions": {"KHR_lights_punctual": {"lights": [{"type":
                "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.5}}]}}})",
                "innerConeAngle 1 must be below outerConeAngle 0.5"},
    SpoiledFile{"light_index", R"({"nodes": [{"mesh": 0, "extensions": {"KHR_lights_punctual":
                {"light": 0}}}]})",
                "/nodes/0/extensions/KHR_lights_punctual/light: 0 is no index of"},
    SpoiledFile{"http", R"({"buffers": [{"uri": "http://host/a.bin", "byteLength": 36}]})",
                "/buffers/0/uri: 'http://host/a.bin': only files beside the scene"},
    SpoiledFile{"absolute_path", R"({"buffers": [{"uri": "/etc/passwd", "byteLength": 36}]})",
                "'/etc/passwd' must be a path relative"},
    SpoiledFile{"missing_buffer", R"({"buffers": [{"uri": "other.bin", "byteLength": 36}]})",
                "/buffers/0/uri: other.bin is not there"},
    SpoiledFile{"short_buffer", R"({"buffers": [{"uri": "scene.bin", "byteLength": 40}]})",
                "/buffers/0: must have 40 bytes, has 36; its file may have been cut short"},
    SpoiledFile{"no_binary_chunk", R"({"buffers": [{"byteLength": 36}]})",
                "/buffers/0: has no 'uri', and the file has no binary chunk"},
    SpoiledFile{"nothing_to_show", R"({"scenes": [{}]})", "shows no triangle"}};

/// Files that are used, with a note.
inline const SpoiledFile kNoted[] = {
    SpoiledFile{"optional_extension", R"({"extensionsUsed": ["KHR_materials_clearcoat"],
              "materials": [{"extensions": {"KHR_materials_clearcoat": {}}},
                            {"extensions": {"KHR_materials_clearcoat": {}}}]})",
                "KHR_materials_clearcoat is not supported: shown without it\n"},
    SpoiledFile{"undeclared_extension",
                R"({"materials": [{"extensions": {"KHR_materials_ior": {}}}]})",
                "KHR_materials_ior is not listed in extensionsUsed"},
    SpoiledFile{"required_but_unused", R"({"extensionsRequired": ["KHR_texture_transform"]})",
                "/extensionsRequired/0: KHR_texture_transform is not listed in extensionsUsed"},
    SpoiledFile{"matrix_and_trs", R"({"nodes": [{"mesh": 0, "translation": [1, 0, 0], "matrix":
              [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]})",
                "/nodes/0: has a matrix and translation, rotation or scale: the matrix counts"},
    SpoiledFile{"unit_quaternion", R"({"nodes": [{"mesh": 0, "rotation": [0, 0, 0, 0.5]}]})",
                "/nodes/0/rotation: has length 0.5, must have 1"},
    SpoiledFile{"unknown_property", R"({"nodes": [{"mesh": 0, "visible": false}]})",
                "/nodes/0/visible: 'visible' has no meaning here: left out"},
    SpoiledFile{"animations", R"({"animations": [{}, {}]})", "/animations: 2 are not supported"},
    SpoiledFile{"no_default_scene", R"({"scene": null, "scenes": [{"nodes": [0]}, {}]})",
                "/scenes: no scene is the default one: the first of 2 is shown"},
    SpoiledFile{"flat", R"({"nodes": [{"mesh": 0, "scale": [1, 0, 1]}, {"mesh": 0}],
              "scenes": [{"nodes": [0, 1]}]})",
                "/nodes/0: is scaled to nothing: not shown"},
    SpoiledFile{"alignment",
                R"({"accessors": [{"bufferView": 0, "byteOffset": 2, "componentType": 5126,
              "count": 2, "type": "VEC3"}, {"bufferView": 0, "componentType": 5126, "count": 3,
              "type": "VEC3", "min": [0,0,0], "max": [1,1,0]}], "meshes": [{"primitives":
              [{"attributes": {"POSITION": 1}}]}]})",
                "/accessors/0: byte 2 is no multiple of its component's 4 bytes"}};

}  // namespace gazeloop::tests
