#include "runtime/scene/light_field_scene.h"

#include <array>
#include <cstring>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

#include "runtime/light_field/likely_views.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::scene {
namespace {

using Type = vk::DescriptorType;

/// Set 1 (shaders/scenes/lightfield.glsl).
constexpr std::array kBindings{Type::eCombinedImageSampler, Type::eStorageBuffer};

/// What a picture's lens is told; std430, followed by its views.
struct LensHeader {
    glm::vec4 focal_plane{0.0F};
    std::array<std::uint32_t, 4> count{};
};
struct LensView {
    glm::vec2 camera_m{0.0F};
    float layer = 0.0F;
    float weight = 0.0F;
};
static_assert(sizeof(LensHeader) == 32 && sizeof(LensView) == 16);

/// What all renderers share.
struct Content {
    Content(const vulkan::Context& of, const LightFieldSource& source,
            const light_field::Lens& lens, const LightFieldMemory& memory)
        : context(of),
          field{.cameras = source.cameras, .lens = lens},
          views(of, source, lens, memory) {
        layout =
            vulkan::make_set_layout(of.device(), kBindings, vk::ShaderStageFlagBits::eFragment);
        // Beyond what a view shows it is black.
        constexpr auto kBorder = vk::SamplerAddressMode::eClampToBorder;
        sampler = vk::raii::Sampler(
            of.device(),
            vk::SamplerCreateInfo({}, vk::Filter::eLinear, vk::Filter::eLinear,
                                  vk::SamplerMipmapMode::eNearest, kBorder, kBorder, kBorder, 0.0F,
                                  VK_FALSE, 1.0F, VK_FALSE, vk::CompareOp::eNever, 0.0F, 0.0F,
                                  vk::BorderColor::eFloatOpaqueBlack));
    }

    const vulkan::Context& context;
    light_field::LightField field;
    LightFieldViews views;  ///< brought as renderers ask for them
    vk::raii::Sampler sampler{nullptr};
    vk::raii::DescriptorSetLayout layout{nullptr};
};

class LightFieldScene : public Scene {
  public:
    explicit LightFieldScene(std::shared_ptr<Content> content) : content_(std::move(content)) {}

    [[nodiscard]] std::string_view shader() const override { return kLightFieldShader; }
    [[nodiscard]] bool is_point_sampled() const override { return true; }
    [[nodiscard]] const light_field::LightField* light_field() const override {
        return &content_->field;
    }
    [[nodiscard]] std::uint32_t layer_of_view(std::uint32_t view) const override {
        return content_->views.layer_of(view);
    }
    [[nodiscard]] std::optional<std::string> account() const override {
        return content_->views.account();
    }
    [[nodiscard]] ViewWaits view_waits() const override { return content_->views.waits(); }
    [[nodiscard]] vk::DescriptorSetLayout inputs() const override { return *content_->layout; }
    [[nodiscard]] std::unique_ptr<Scene> for_renderer(const RendererPictures& pictures) override;

  protected:
    [[nodiscard]] Content& content() const { return *content_; }

  private:
    std::shared_ptr<Content> content_;
};

/// With the lenses of one renderer's frames.
class LightFieldOfRenderer final : public LightFieldScene {
  public:
    LightFieldOfRenderer(const std::shared_ptr<Content>& shared, std::uint32_t slots)
        : LightFieldScene(shared), likely_(shared->field) {
        const vk::raii::Device& device = content().context.device();
        const std::uint32_t sets = slots * static_cast<std::uint32_t>(gaze::kEyeCount);
        const std::array sizes{vk::DescriptorPoolSize(Type::eCombinedImageSampler, sets),
                               vk::DescriptorPoolSize(Type::eStorageBuffer, sets)};
        pool_ = vk::raii::DescriptorPool(
            device, vk::DescriptorPoolCreateInfo(
                        vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, sets, sizes));
        slots_.resize(slots);
        wanted_.reserve(gaze::kEyeCount * content().field.cameras.count());
        for (auto& slot : slots_) {
            for (EyeSlot& at : slot) {
                make_slot(at);
            }
        }
    }

    [[nodiscard]] std::unique_ptr<Scene> for_renderer(
        const RendererPictures& /*pictures*/) override {
        return nullptr;
    }

    [[nodiscard]] vk::DescriptorSet inputs_of(gaze::Eye eye, std::size_t slot) const override {
        return *slots_[slot][gaze::index(eye)].set;
    }

    void record_geometry(vulkan::PassRecorder& /*recorder*/, const gaze::StereoView& views,
                         double /*time_s*/, std::size_t slot) override {
        const light_field::LightField& field = content().field;
        const auto lens_of = [&](std::size_t e) {
            return light_field::ViewsInLens(field, views[e].pose.position_m);
        };
        wanted_.clear();
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            lens_of(e).for_each(
                [&](const light_field::WeightedView& view) { wanted_.push_back(view.view); });
        }
        content().views.bring(wanted_);
        fetch_ahead(views);
        const double focus_m = field.lens.focus_m;
        const glm::dvec2 shares = 0.5 / (focus_m * field.cameras.half_tangents);
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            const vulkan::HostBuffer& lens = slots_[slot][e].lens;
            LensHeader header{.focal_plane = glm::vec4(glm::dvec4(focus_m, shares, 0.0))};
            std::size_t at = sizeof header;
            lens_of(e).for_each([&](const light_field::WeightedView& view) {
                const LensView one{.camera_m = glm::vec2(view.camera_m),
                                   .layer = static_cast<float>(layer_of_view(view.view)),
                                   .weight = static_cast<float>(view.weight)};
                std::memcpy(lens.mapped().subspan(at).data(), &one, sizeof one);
                at += sizeof one;
                ++header.count[0];
            });
            std::memcpy(lens.mapped().data(), &header, sizeof header);
        }
    }

  private:
    struct EyeSlot {
        vulkan::HostBuffer lens;
        vk::raii::DescriptorSet set{nullptr};
    };

    /// What the next frame may ask for, if the head goes on as it came.
    void fetch_ahead(const gaze::StereoView& views) {
        if (!content().views.fetches_ahead()) {
            return;
        }
        gaze::PerEye<light_field::MovingLens> lenses;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            const glm::dvec2 middle_m =
                light_field::ViewsInLens(content().field, views[e].pose.position_m).middle_m();
            lenses[e] = {middle_m,
                         last_middles_m_ ? middle_m - (*last_middles_m_)[e] : glm::dvec2(0.0)};
        }
        last_middles_m_ = {lenses[0].middle_m, lenses[1].middle_m};
        content().views.fetch_ahead(likely_.after(lenses));
    }

    void make_slot(EyeSlot& at) const {
        const vk::raii::Device& device = content().context.device();
        at.lens = vulkan::HostBuffer(
            content().context,
            sizeof(LensHeader) + content().field.cameras.count() * sizeof(LensView),
            vk::BufferUsageFlagBits::eStorageBuffer);
        at.set = std::move(vk::raii::DescriptorSets(
            device, vk::DescriptorSetAllocateInfo(*pool_, *content().layout))[0]);
        const vk::DescriptorImageInfo image(*content().sampler, content().views.image(),
                                            vk::ImageLayout::eShaderReadOnlyOptimal);
        const vk::DescriptorBufferInfo buffer(at.lens.buffer(), 0, VK_WHOLE_SIZE);
        device.updateDescriptorSets(
            {vk::WriteDescriptorSet(*at.set, 0, 0, Type::eCombinedImageSampler, image),
             vk::WriteDescriptorSet(*at.set, 1, 0, Type::eStorageBuffer, {}, buffer)},
            {});
    }

    vk::raii::DescriptorPool pool_{nullptr};
    std::vector<gaze::PerEye<EyeSlot>> slots_;
    std::vector<std::uint32_t> wanted_;  ///< views of the frame
    light_field::LikelyViews likely_;
    std::optional<gaze::PerEye<glm::dvec2>> last_middles_m_;  ///< of the lenses, a frame before
};

std::unique_ptr<Scene> LightFieldScene::for_renderer(const RendererPictures& pictures) {
    return std::make_unique<LightFieldOfRenderer>(content_, pictures.slots);
}

}  // namespace

std::unique_ptr<Scene> make_light_field_scene(const vulkan::Context& context,
                                              const LightFieldSource& source,
                                              const light_field::Lens& lens,
                                              const LightFieldMemory& memory) {
    return std::make_unique<LightFieldScene>(
        std::make_shared<Content>(context, source, lens, memory));
}

}  // namespace gazeloop::scene
