#pragma once

#include "runtime/gaze/hidden_mesh.h"
#include "runtime/openxr/xr_check.h"

namespace gazeloop::present {

/// What the views of a session hide from the eyes, by XR_KHR_visibility_mask.
class VisibilityMask {
  public:
    /// More triangles are treated as a runtime's error.
    static constexpr std::uint32_t kMostTriangles = 8192;

    /// For instances that have the extension enabled; others have no mask.
    explicit VisibilityMask(XrInstance instance);

    /// Asks for both eyes' hidden triangles. Null where no eye has any. Whatever a runtime gives
    /// that is no list of triangles counts as none, with a warning in the log. Throws SetupError
    /// (SessionLost) when the session is gone.
    [[nodiscard]] gaze::HiddenMeshes query(XrSession session,
                                           XrViewConfigurationType configuration) const;

  private:
    [[nodiscard]] gaze::HiddenMesh query_view(XrSession session,
                                              XrViewConfigurationType configuration,
                                              std::uint32_t view) const;

    PFN_xrGetVisibilityMaskKHR get_;
};

}  // namespace gazeloop::present
