#include "runtime/scene/mesh_scene.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "runtime/scene/eye_camera.h"
#include "runtime/scene/mesh_content.h"

namespace gazeloop::scene {
namespace {

frame::PassList passes_of(const MeshNeeds& needs) {
    std::string names;
    const auto add = [&](bool wanted, std::string_view name) {
        if (wanted) {
            names += names.empty() ? "" : " ";
            names += name;
        }
    };
    add(needs.depth_first, "depth");
    add(needs.shadows, "shadow");
    add(true, "defer");
    add(needs.glass, "glass");
    add(true, "sky");
    return value_or_throw(frame::PassList::parse(names, frame::kMostPasses));
}

/// What all renderers ask alike.
class MeshSceneBase : public Scene {
  public:
    explicit MeshSceneBase(std::shared_ptr<MeshContent> content)
        : content_(std::move(content)), passes_(passes_of(content_->needs())) {}
    [[nodiscard]] std::string_view shader() const override { return kMeshShader; }
    [[nodiscard]] std::span<const vulkan::ShaderConstant> constants() const override {
        return content_->constants();
    }
    [[nodiscard]] std::span<const std::string> skipped() const override {
        return content_->needs().skipped;
    }
    [[nodiscard]] bool is_point_sampled() const override { return true; }
    [[nodiscard]] frame::PassList passes() const override { return passes_; }
    [[nodiscard]] vk::DescriptorSetLayout inputs() const override {
        return content_->lighting_layout();
    }

  protected:
    [[nodiscard]] MeshContent& content() const { return *content_; }
    [[nodiscard]] const std::shared_ptr<MeshContent>& shared() const { return content_; }

  private:
    std::shared_ptr<MeshContent> content_;
    frame::PassList passes_;
};

/// The scene with the G-buffers of one renderer. One of each eye serves all frames: the queue
/// works in order.
class MeshPictures final : public MeshSceneBase {
  public:
    MeshPictures(const std::shared_ptr<MeshContent>& shared, const RendererPictures& pictures)
        : MeshSceneBase(shared) {
        const bool glass = content().needs().glass;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            Eye& eye = eyes_[e];
            eye.extent = pictures.extents[e];
            eye.surfaces = make_layer(eye.extent);
            if (glass) {
                eye.glass = make_layer(eye.extent);
            }
        }
        make_sets(pictures.slots);
    }

    [[nodiscard]] vk::DescriptorSet inputs_of(gaze::Eye eye, std::size_t slot) const override {
        return *slots_[slot][gaze::index(eye)].lighting_set;
    }

    void record_geometry(vulkan::PassRecorder& recorder, const gaze::StereoView& views,
                         double /*time_s*/, std::size_t slot) override {
        const MeshNeeds& needs = content().needs();
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            ViewUniforms uniforms = view_uniforms(views[e]);
            uniforms.to_sun = content().to_sun();
            uniforms.sun = content().sun();
            slots_[slot][e].uniforms.write(uniforms);
            const mesh::Frustum frustum = frustum_of(views[e]);
            content().choose(MeshContent::Pass::Surfaces, frustum, eyes_[e].surface_draws);
            content().choose(MeshContent::Pass::Glass, frustum, eyes_[e].glass_draws);
            EyeSlot& at = slots_[slot][e];
            const std::span<std::uint32_t> indices = at.index_span();
            std::uint32_t used = 0;
            content().face(eyes_[e].surface_draws, frustum, indices, used, at.surfaces);
            content().face(eyes_[e].glass_draws, frustum, indices, used, at.glass);
        }
        if (content().shadows_due()) {
            content().draw_shadows(recorder.begin("shadow"));
        }
        if (needs.depth_first) {
            const vk::raii::CommandBuffer& commands = recorder.begin("depth");
            for_eyes(slot, [&](Eye& eye, const EyeSlot& /*at*/) {
                eye.surfaces.depth_use.use(commands, vulkan::Use::DepthTarget,
                                           vulkan::Keep::Nothing);
            });
            for_eyes(slot, [&](Eye& eye, const EyeSlot& at) {
                begin(commands, eye.extent, nullptr, eye.surfaces, vk::AttachmentLoadOp::eClear);
                content().draw(commands, MeshContent::Pass::Depth, *at.view_set, eye.surface_draws,
                               &at.surfaces);
                commands.endRendering();
            });
        }
        draw_surfaces(recorder.begin("defer"), slot);
        if (needs.glass) {
            draw_glass(recorder.begin("glass"), slot);
        }
        const vk::raii::CommandBuffer& commands = recorder.begin("sky");
        for_eyes(slot, [&](Eye& eye, const EyeSlot& /*at*/) {
            eye.surfaces.color_use.use(commands, vulkan::Use::ColorTarget);
            eye.surfaces.depth_use.use(commands, vulkan::Use::DepthTarget);
        });
        for_eyes(slot, [&](Eye& eye, const EyeSlot& at) {
            begin(commands, eye.extent, &eye.surfaces, eye.surfaces, vk::AttachmentLoadOp::eLoad);
            content().draw_sky(commands, *at.view_set);
            commands.endRendering();
        });
        for_eyes(slot, [&](Eye& eye, const EyeSlot& /*at*/) {
            eye.surfaces.color_use.use(commands, vulkan::Use::Sampled);
            eye.surfaces.depth_use.use(commands, vulkan::Use::Sampled);
        });
    }

  private:
    /// A picture of surfaces and its depth.
    struct Layer {
        vulkan::LayeredImage color;
        vulkan::LayeredImage depth;
        vulkan::TrackedImage color_use;
        vulkan::TrackedImage depth_use;
    };
    struct Eye {
        vk::Extent2D extent;
        Layer surfaces;
        Layer glass;
        std::vector<mesh::Draw> surface_draws;
        std::vector<mesh::Draw> glass_draws;
    };
    struct EyeSlot {
        vulkan::HostBuffer uniforms;
        vulkan::HostBuffer indices;
        FacingIndices surfaces;
        FacingIndices glass;
        vk::raii::DescriptorSet view_set{nullptr};
        vk::raii::DescriptorSet lighting_set{nullptr};

        [[nodiscard]] std::span<std::uint32_t> index_span() const {
            const std::span<std::byte> bytes = indices.mapped();
            return {reinterpret_cast<std::uint32_t*>(bytes.data()),
                    bytes.size() / sizeof(std::uint32_t)};
        }
    };
    /// Of an eye's frame: what does not fit is drawn whole.
    static constexpr std::size_t kMostIndices = std::size_t{2} << 20U;

    [[nodiscard]] Layer make_layer(vk::Extent2D extent) const {
        using Usage = vk::ImageUsageFlagBits;
        const vulkan::Context& context = content().context();
        Layer layer;
        layer.color =
            vulkan::LayeredImage(context, {.extent = extent,
                                           .format = kGBufferFormat,
                                           .usage = Usage::eColorAttachment | Usage::eSampled});
        layer.depth = vulkan::LayeredImage(
            context, {.extent = extent,
                      .format = kSceneDepthFormat,
                      .usage = Usage::eDepthStencilAttachment | Usage::eSampled |
                               Usage::eTransferSrc | Usage::eTransferDst,
                      .aspect = vk::ImageAspectFlagBits::eDepth});
        layer.color_use =
            vulkan::TrackedImage(layer.color.image(), vk::ImageAspectFlagBits::eColor);
        layer.depth_use =
            vulkan::TrackedImage(layer.depth.image(), vk::ImageAspectFlagBits::eDepth);
        return layer;
    }

    void make_sets(std::uint32_t slots) {
        using Type = vk::DescriptorType;
        const vk::raii::Device& device = content().context().device();
        const std::uint32_t sets = slots * static_cast<std::uint32_t>(gaze::kEyeCount);
        const std::array sizes{vk::DescriptorPoolSize(Type::eUniformBuffer, 2 * sets),
                               vk::DescriptorPoolSize(Type::eStorageBuffer, sets),
                               vk::DescriptorPoolSize(Type::eCombinedImageSampler, 6 * sets)};
        pool_ = vk::raii::DescriptorPool(
            device, vk::DescriptorPoolCreateInfo(
                        vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 2 * sets, sizes));
        slots_.resize(slots);
        for (auto& slot : slots_) {
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                EyeSlot& at = slot[e];
                at.uniforms = vulkan::HostBuffer(content().context(), sizeof(ViewUniforms),
                                                 vk::BufferUsageFlagBits::eUniformBuffer);
                at.indices = vulkan::HostBuffer(
                    content().context(),
                    sizeof(std::uint32_t) *
                        std::clamp<std::size_t>(content().most_indices(), 3, kMostIndices),
                    vk::BufferUsageFlagBits::eIndexBuffer);
                at.surfaces.buffer = at.indices.buffer();
                at.glass.buffer = at.indices.buffer();
                const std::array layouts{content().view_layout(), content().lighting_layout()};
                vk::raii::DescriptorSets made(device,
                                              vk::DescriptorSetAllocateInfo(*pool_, layouts));
                at.view_set = std::move(made[0]);
                at.lighting_set = std::move(made[1]);
                content().write_view_set(*at.view_set, at.uniforms.buffer());
                const Eye& eye = eyes_[e];
                const bool glass = content().needs().glass;
                content().write_lighting_set(*at.lighting_set, eye.surfaces.color.view(),
                                             eye.surfaces.depth.view(),
                                             glass ? eye.glass.color.view() : vk::ImageView{},
                                             glass ? eye.glass.depth.view() : vk::ImageView{});
            }
        }
    }

    /// Barriers of both eyes come before the drawing of either: between the eyes, they would have
    /// the second one's vertices wait for the first one's pixels.
    template <typename Draw>
    void for_eyes(std::size_t slot, const Draw& draw) {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            draw(eyes_[e], std::as_const(slots_[slot][e]));
        }
    }

    /// Begins rendering into a layer's colours, unless null, and a layer's depth.
    static void begin(const vk::raii::CommandBuffer& commands, vk::Extent2D extent,
                      const Layer* color, const Layer& depth, vk::AttachmentLoadOp depth_load) {
        const vk::AttachmentLoadOp load = depth_load == vk::AttachmentLoadOp::eLoad
                                              ? vk::AttachmentLoadOp::eLoad
                                              : vk::AttachmentLoadOp::eClear;
        begin(commands, extent, color, load, depth, depth_load);
    }
    static void begin(const vk::raii::CommandBuffer& commands, vk::Extent2D extent,
                      const Layer* color, vk::AttachmentLoadOp color_load, const Layer& depth,
                      vk::AttachmentLoadOp depth_load) {
        const vk::RenderingAttachmentInfo color_info(
            color != nullptr ? color->color.view() : vk::ImageView{},
            vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {}, color_load,
            vk::AttachmentStoreOp::eStore, vk::ClearColorValue(std::array<std::uint32_t, 4>{}));
        const vk::RenderingAttachmentInfo depth_info(
            depth.depth.view(), vk::ImageLayout::eDepthStencilAttachmentOptimal, {}, {}, {},
            depth_load, vk::AttachmentStoreOp::eStore,
            vk::ClearValue(vk::ClearDepthStencilValue(0.0F, 0)));
        const vk::Rect2D area({0, 0}, extent);
        commands.beginRendering(vk::RenderingInfo({}, area, 1, 0, color != nullptr ? 1U : 0U,
                                                  &color_info, &depth_info));
        commands.setViewport(0, vk::Viewport(0.0F, 0.0F, static_cast<float>(extent.width),
                                             static_cast<float>(extent.height), 0.0F, 1.0F));
        commands.setScissor(0, area);
    }

    void draw_surfaces(const vk::raii::CommandBuffer& commands, std::size_t slot) {
        const bool depth_first = content().needs().depth_first;
        for_eyes(slot, [&](Eye& eye, const EyeSlot& /*at*/) {
            eye.surfaces.color_use.use(commands, vulkan::Use::ColorTarget, vulkan::Keep::Nothing);
            eye.surfaces.depth_use.use(commands, vulkan::Use::DepthTarget,
                                       depth_first ? vulkan::Keep::Content : vulkan::Keep::Nothing);
        });
        for_eyes(slot, [&](Eye& eye, const EyeSlot& at) {
            // What nothing is drawn over, the sky is: its colours need no clearing.
            begin(commands, eye.extent, &eye.surfaces, vk::AttachmentLoadOp::eDontCare,
                  eye.surfaces,
                  depth_first ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear);
            content().draw(commands, MeshContent::Pass::Surfaces, *at.view_set, eye.surface_draws,
                           &at.surfaces);
            commands.endRendering();
        });
    }

    void draw_glass(const vk::raii::CommandBuffer& commands, std::size_t slot) {
        // Only what is nearer than every surface is drawn.
        for_eyes(slot, [&](Eye& eye, const EyeSlot& /*at*/) {
            eye.surfaces.depth_use.use(commands, vulkan::Use::CopySource);
            eye.glass.depth_use.use(commands, vulkan::Use::CopyTarget, vulkan::Keep::Nothing);
            eye.glass.color_use.use(commands, vulkan::Use::ColorTarget, vulkan::Keep::Nothing);
        });
        for_eyes(slot, [&](Eye& eye, const EyeSlot& /*at*/) {
            const vk::ImageSubresourceLayers depth(vk::ImageAspectFlagBits::eDepth, 0, 0, 1);
            commands.copyImage(eye.surfaces.depth.image(), vk::ImageLayout::eTransferSrcOptimal,
                               eye.glass.depth.image(), vk::ImageLayout::eTransferDstOptimal,
                               vk::ImageCopy(depth, {}, depth, {}, vk::Extent3D(eye.extent, 1)));
        });
        for_eyes(slot, [&](Eye& eye, const EyeSlot& /*at*/) {
            eye.glass.depth_use.use(commands, vulkan::Use::DepthTarget);
        });
        for_eyes(slot, [&](Eye& eye, const EyeSlot& at) {
            begin(commands, eye.extent, &eye.glass, vk::AttachmentLoadOp::eClear, eye.glass,
                  vk::AttachmentLoadOp::eLoad);
            content().draw(commands, MeshContent::Pass::Glass, *at.view_set, eye.glass_draws,
                           &at.glass);
            commands.endRendering();
        });
        for_eyes(slot, [&](Eye& eye, const EyeSlot& /*at*/) {
            eye.glass.color_use.use(commands, vulkan::Use::Sampled);
            eye.glass.depth_use.use(commands, vulkan::Use::Sampled);
        });
    }

    gaze::PerEye<Eye> eyes_;
    vk::raii::DescriptorPool pool_{nullptr};
    std::vector<gaze::PerEye<EyeSlot>> slots_;
};

/// The scene that all renderers share.
class MeshScene final : public MeshSceneBase {
  public:
    using MeshSceneBase::MeshSceneBase;
    [[nodiscard]] std::unique_ptr<Scene> for_renderer(const RendererPictures& pictures) override {
        return std::make_unique<MeshPictures>(shared(), pictures);
    }
};

}  // namespace

std::unique_ptr<Scene> make_mesh_scene(const vulkan::Context& context, const mesh::MeshData& data,
                                       const SceneOptions& options) {
    return std::make_unique<MeshScene>(std::make_shared<MeshContent>(
        context, data, needs_of(data, options.require_all),
        HighlightFilters{.pixel = options.specular_filter, .footprint = options.footprint}));
}

}  // namespace gazeloop::scene
