#pragma once

#include <string>

#include "runtime/scene/scene.h"

namespace gazeloop::scene {

/// A scene that is a function of a ray alone: its shader needs no input, and nothing is drawn
/// before.
class RayScene final : public Scene {
  public:
    explicit RayScene(std::string_view shader) : shader_(shader) {}
    [[nodiscard]] std::string_view shader() const override { return shader_; }

  private:
    std::string shader_;
};

}  // namespace gazeloop::scene
