#pragma once

#include "runtime/gaze/view.h"
#include "runtime/openxr/session.h"

namespace gazeloop::present {

/// The head and the views that the eyes' pictures are rendered from, as the runtime says. Where it
/// gives impossible values (untracked, not numbers, empty fields of view), the last good ones stand
/// and the session is told.
class OpenXrViews {
  public:
    /// `session` must outlive this.
    OpenXrViews(openxr::Session& session, const gaze::PerEye<vk::Extent2D>& extents)
        : session_(session), extents_(extents) {}

    /// At a display time, in LOCAL space. One that is not good may be refused: then all stands as
    /// it was. Throws SetupError: SessionLost when the runtime refuses, NoDevice when it never gave
    /// a field of view that can be rendered for.
    void locate(XrTime display_time, bool is_good);

    [[nodiscard]] const gaze::StereoView& views() const { return views_; }
    [[nodiscard]] const gaze::Pose& head() const { return head_; }

  private:
    /// False if it cannot be rendered for.
    [[nodiscard]] bool take_field_of_view(std::size_t eye, const XrFovf& fov);
    struct Said {
        const frame::EventKind& kind;
        const char* text;
    };
    void say_change(bool now, bool& before, const Said& good, const Said& bad);

    openxr::Session& session_;
    gaze::PerEye<vk::Extent2D> extents_;
    gaze::StereoView views_;
    gaze::Pose head_;
    bool tracked_ = true;
    bool rendered_for_ = true;
};

}  // namespace gazeloop::present
