#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/gaze/eye.h"
#include "runtime/gaze/view.h"
#include "runtime/light_field/lens.h"
#include "runtime/scene/view_waits.h"
#include "runtime/vulkan/pass_recorder.h"
#include "runtime/vulkan/pipelines.h"

namespace gazeloop::scene {

/// The pictures of one renderer, for scenes that draw into pictures of their own before.
struct RendererPictures {
    gaze::PerEye<vk::Extent2D> extents;
    std::uint32_t slots = 1;  ///< frames that may be in flight
};

/// What is rendered: one for all renderers of a process. Its shader answers radiance, distance and
/// motion at a place of the picture (shaders/lib/scene.glsl); inputs of that shader are descriptor
/// set 1.
class Scene {
  public:
    Scene() = default;
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;
    virtual ~Scene() = default;

    /// shaders/scenes/NAME.glsl.
    [[nodiscard]] virtual std::string_view shader() const = 0;

    /// Specialization constants of its shader, constant_id from 16.
    [[nodiscard]] virtual std::span<const vulkan::ShaderConstant> constants() const { return {}; }

    /// Whether its answers jump from pixel to pixel, so that samples farther apart alias.
    [[nodiscard]] virtual bool is_point_sampled() const { return false; }

    /// Its cameras and the lens that they are seen through, if it is a light field: its shader then
    /// also answers view by view (SCENE_OF_VIEWS). Null: it is none.
    [[nodiscard]] virtual const light_field::LightField* light_field() const { return nullptr; }

    /// Where its shader finds a view of the light field that the frame recorded last is made of.
    [[nodiscard]] virtual std::uint32_t layer_of_view(std::uint32_t view) const { return view; }

    /// What it did from frame to frame that a user should know of, for people; none: nothing.
    [[nodiscard]] virtual std::optional<std::string> account() const { return std::nullopt; }

    /// How its frames waited for views of a light field until now.
    [[nodiscard]] virtual ViewWaits view_waits() const { return {}; }

    /// The same scene for the pictures of one renderer, which asks it instead. Null: this one
    /// serves all. It must not outlive this.
    [[nodiscard]] virtual std::unique_ptr<Scene> for_renderer(
        const RendererPictures& /*pictures*/) {
        return nullptr;
    }

    /// What of its work is left out because nothing shown needs it, for people.
    [[nodiscard]] virtual std::span<const std::string> skipped() const { return {}; }

    /// Passes of its own, recorded before those of the method.
    [[nodiscard]] virtual frame::PassList passes() const { return {}; }

    /// Layout of the inputs, set 1; null: the shader has none.
    [[nodiscard]] virtual vk::DescriptorSetLayout inputs() const { return {}; }
    /// The inputs of one eye's picture in a frame slot. Null: none.
    [[nodiscard]] virtual vk::DescriptorSet inputs_of(gaze::Eye /*eye*/,
                                                      std::size_t /*slot*/) const {
        return {};
    }

    /// Records what must be drawn before the shader can be asked, for these views: needs no gaze.
    virtual void record_geometry(vulkan::PassRecorder& /*recorder*/,
                                 const gaze::StereoView& /*views*/, double /*time_s*/,
                                 std::size_t /*slot*/) {}
};

}  // namespace gazeloop::scene
