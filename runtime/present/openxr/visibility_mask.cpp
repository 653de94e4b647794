#include "runtime/present/openxr/visibility_mask.h"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace gazeloop::present {

using openxr::typed;
using openxr::xr_function;

VisibilityMask::VisibilityMask(XrInstance instance)
    : get_(xr_function<PFN_xrGetVisibilityMaskKHR>(instance, "xrGetVisibilityMaskKHR")) {}

gaze::HiddenMeshes VisibilityMask::query(XrSession session,
                                         XrViewConfigurationType configuration) const {
    const auto meshes = std::make_shared<gaze::PerEye<gaze::HiddenMesh>>();
    for (const gaze::Eye eye : gaze::kEyes) {
        (*meshes)[gaze::index(eye)] =
            query_view(session, configuration, static_cast<std::uint32_t>(gaze::index(eye)));
    }
    return std::ranges::all_of(*meshes, &gaze::HiddenMesh::empty) ? nullptr : meshes;
}

gaze::HiddenMesh VisibilityMask::query_view(XrSession session,
                                            XrViewConfigurationType configuration,
                                            std::uint32_t view) const {
    auto mask = typed<XrVisibilityMaskKHR>(XR_TYPE_VISIBILITY_MASK_KHR);
    std::vector<XrVector2f> vertices;
    std::vector<std::uint32_t> indices;
    const auto call = [&] {
        return XR_SUCCEEDED(get_(session, configuration, view,
                                 XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR, &mask));
    };
    const auto refuse = [&](std::string_view why) {
        spdlog::warn("the runtime's visibility mask of view {} is not used: {}", view, why);
        return gaze::HiddenMesh{};
    };
    if (!call()) {
        return refuse("the runtime does not say it");
    }
    if (mask.indexCountOutput > 3 * kMostTriangles || mask.vertexCountOutput > 3 * kMostTriangles) {
        return refuse("it is too large");
    }
    vertices.resize(mask.vertexCountOutput);
    indices.resize(mask.indexCountOutput);
    if (indices.empty() || vertices.empty()) {
        return {};
    }
    mask.vertexCapacityInput = mask.vertexCountOutput;
    mask.indexCapacityInput = mask.indexCountOutput;
    mask.vertices = vertices.data();
    mask.indices = indices.data();
    if (!call()) {
        return refuse("it changed while it was asked for");
    }
    indices.resize(std::min<std::size_t>(indices.size(), mask.indexCountOutput));
    vertices.resize(std::min<std::size_t>(vertices.size(), mask.vertexCountOutput));
    if (indices.empty()) {
        return {};
    }
    if (indices.size() % 3 != 0 || std::ranges::max(indices) >= vertices.size()) {
        return refuse("it is no list of triangles");
    }
    gaze::HiddenMesh mesh(indices.size() / 3);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const XrVector2f& vertex = vertices[indices[i]];
        mesh[i / 3].corners[i % 3] = {vertex.x, vertex.y};
    }
    return mesh;
}

}  // namespace gazeloop::present
