// What a headset may hide. Effects of xrGetVisibilityMaskKHR:
//   half (the left half of the view), none, odd (no list of triangles)
#include <algorithm>
#include <vector>

#include "tests/support/openxr_layer/layer.h"

namespace gazeloop::tests {
namespace {

XrResult give(const std::vector<XrVector2f>& vertices, const std::vector<std::uint32_t>& indices,
              XrVisibilityMaskKHR* mask) {
    mask->vertexCountOutput = static_cast<std::uint32_t>(vertices.size());
    mask->indexCountOutput = static_cast<std::uint32_t>(indices.size());
    if (mask->vertexCapacityInput >= vertices.size() &&
        mask->indexCapacityInput >= indices.size()) {
        std::ranges::copy(vertices, mask->vertices);
        std::ranges::copy(indices, mask->indices);
    }
    return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL get_visibility_mask(XrSession session,
                                                   XrViewConfigurationType configuration,
                                                   std::uint32_t view, XrVisibilityMaskTypeKHR type,
                                                   XrVisibilityMaskKHR* mask) {
    constexpr const char* kName = "xrGetVisibilityMaskKHR";
    const auto effect = layer().plan.call(kName);
    if (!effect) {
        return next<PFN_xrGetVisibilityMaskKHR>(kName)(session, configuration, view, type, mask);
    }
    if (*effect == "half") {
        return give({{-9, -9}, {0, -9}, {0, 9}, {-9, 9}}, {0, 1, 2, 0, 2, 3}, mask);
    }
    if (*effect == "odd") {
        return give({{-1, -1}, {0, -1}, {0, 1}}, {0, 1, 9}, mask);
    }
    if (*effect != "none") {
        refuse_fault(kName, *effect);
    }
    return give({}, {}, mask);
}

}  // namespace

PFN_xrVoidFunction mask_hook(std::string_view name) {
    return name == "xrGetVisibilityMaskKHR" ? as_hook(&get_visibility_mask) : nullptr;
}

}  // namespace gazeloop::tests
