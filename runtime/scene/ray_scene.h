#pragma once

#include <array>
#include <string>

#include "runtime/scene/scene.h"

namespace gazeloop::scene {

/// A scene that is a function of a ray alone: its shader needs no input, and nothing is drawn
/// before.
class RayScene final : public Scene {
  public:
    /// `footprint`: detail that is finer than the samples lie apart fades.
    RayScene(std::string_view shader, bool footprint)
        : shader_(shader), constants_{vulkan::ShaderConstant{kFootprint, footprint ? 1U : 0U}} {}
    [[nodiscard]] std::string_view shader() const override { return shader_; }
    [[nodiscard]] std::span<const vulkan::ShaderConstant> constants() const override {
        return constants_;
    }

  private:
    /// constant_id in shaders/scenes/raymarch.glsl.
    static constexpr std::uint32_t kFootprint = 16;

    std::string shader_;
    std::array<vulkan::ShaderConstant, 1> constants_;
};

}  // namespace gazeloop::scene
