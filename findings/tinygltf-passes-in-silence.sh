#!/usr/bin/env bash
# tinygltf 2.7.0 (Debian 12's libtinygltf-dev): true, without an error or a warning, is no word on a file.
#
# An optional integer that is written as a whole float counts as absent: "mesh": 0.0 (valid by the
# standard, and by Khronos' validator) loads as a node without a mesh, so that the scene is empty. A
# required extension is not looked at: EXT_mesh_gpu_instancing in extensionsRequired loads as one
# instance. Indices without a bufferView (zeros, or all sparse), which the standard allows, are refused. A
# number of an extension is kept as an int: 3000000000 becomes -1294967296.
# All of these files are valid. Check the JSON against the standard before, and what came of it after.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
apt-get download -q libtinygltf-dev=2.7.0+dfsg-2 libtinygltf2d=2.7.0+dfsg-2 >/dev/null 2>&1
for package in *.deb; do dpkg-deb -x "$package" root; done

cat >silence.cpp <<'CODE'
#include <cstdio>
#include <string>
#include <tiny_gltf.h>

static int unexpected = 0;

struct Result {
    bool is_loaded;
    std::string said;
    tinygltf::Model model;
};

static Result load(const std::string& parts) {
    Result result;
    std::string warnings;
    tinygltf::TinyGLTF reader;
    const std::string text =
        R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
        std::string(48, 'A') + R"("}], "bufferViews": [{"buffer": 0, "byteLength": 36}],)" + parts + "}";
    result.is_loaded = reader.LoadASCIIFromString(&result.model, &result.said, &warnings, text.data(),
                                                  static_cast<unsigned>(text.size()), "");
    result.said += warnings;
    return result;
}

static void expect(const char* what, bool as_stated) {
    std::printf("%-60s %s\n", what, as_stated ? "yes" : "NO");
    unexpected += as_stated ? 0 : 1;
}

static bool in_silence(const Result& result) { return result.is_loaded && result.said.empty(); }

int main() {
    const std::string accessor =
        R"("accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],)";
    const std::string mesh = R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}])";

    Result result = load(accessor + mesh + R"(, "nodes": [{"mesh": 0.0}])");
    expect("\"mesh\": 0.0 is no mesh", in_silence(result) && result.model.nodes[0].mesh == -1);
    result = load(R"("extensionsRequired": ["EXT_mesh_gpu_instancing"])");
    expect("a required extension is passed over", in_silence(result));
    result = load(R"("accessors": [{"componentType": 5123, "count": 3, "type": "SCALAR"},
        {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0}]}])");
    expect("indices without a view are refused", !result.is_loaded);
    result = load(R"("materials": [{"extensions": {"KHR_materials_emissive_strength":
        {"emissiveStrength": 3000000000}}}])");
    expect("3000000000 becomes -1294967296",
           in_silence(result) && result.model.materials[0]
                                         .extensions["KHR_materials_emissive_strength"]
                                         .Get("emissiveStrength")
                                         .GetNumberAsDouble() == -1294967296.0);
    std::puts(unexpected == 0 ? "as stated" : "NOT as stated: this finding is out of date");
    return unexpected == 0 ? 0 : 1;
}
CODE
g++ -std=c++17 -O1 -Iroot/usr/include silence.cpp -Lroot/usr/lib/x86_64-linux-gnu -ltinygltf -o silence
LD_LIBRARY_PATH=root/usr/lib/x86_64-linux-gnu ./silence
