#pragma once

#include <array>

#include "runtime/openxr/session.h"
#include "runtime/present/button_source.h"

namespace gazeloop::drivers {

/// What is pressed on the controllers of an OpenXR runtime: an action for each present::Button,
/// with bindings suggested for the controllers of the core specification. Where a controller has
/// fewer buttons than there are choices, the last ones are missing.
class AnswerActions final : public present::ButtonSource {
  public:
    /// The session's action sets must not be attached yet; it must outlive this. Throws SetupError
    /// (NoDevice) where the runtime takes none of the bindings.
    explicit AnswerActions(openxr::Session& session);
    AnswerActions(const AnswerActions&) = delete;
    AnswerActions& operator=(const AnswerActions&) = delete;
    ~AnswerActions() override;

    /// Throws SetupError (SessionLost) when the runtime is gone.
    void take(std::vector<present::Pressed>& pressed) override;

  private:
    void suggest_bindings() const;
    [[nodiscard]] bool is_down(XrAction action) const;

    const openxr::Session& session_;
    XrActionSet set_ = XR_NULL_HANDLE;
    std::array<XrAction, present::kButtonCount> actions_{};
    present::PressEdges edges_;
};

}  // namespace gazeloop::drivers
