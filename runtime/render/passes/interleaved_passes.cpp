#include "runtime/render/passes/interleaved_passes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "runtime/foveation/plans/interleaved_plan.h"
#include "runtime/foveation/plans/kfr_plan.h"
#include "runtime/render/frame_uniforms.h"
#include "runtime/render/map_buffers.h"
#include "runtime/render/passes/drawing.h"
#include "runtime/render/passes/log_polar_sets.h"
#include "runtime/render/passes/planned_passes.h"
#include "runtime/vulkan/history.h"
#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {
namespace {

using foveation::InterleavedPlan;
using foveation::MapUniforms;
using Type = vk::DescriptorType;

/// Nothing that is kept is rounded to halves, because the error would add up; and the last bits of
/// nearness carry more.
constexpr vk::Format kKeptFormat = vk::Format::eR32G32B32A32Sfloat;

/// Set 2: the map, InterleavedUniforms, then images: no more of them than every device can load.
constexpr std::array kKeepBindings{kMapBindings[0],     kMapBindings[1], kMapBindings[2],
                                   kMapBindings[3],     kMapBindings[4], Type::eUniformBuffer,
                                   Type::eStorageImage,   // texels
                                   Type::eStorageImage,   // pixels
                                   Type::eStorageImage,   // cells of texels
                                   Type::eStorageImage};  // cells of pixels
enum InterleavedBinding : std::uint32_t {
    kUniforms = 5,
    kKept = 6,  ///< the last frame's; for the resolve, this one's
    kCells = 8,
};
/// Set 2 of shading and of the resolve. Without the cells, though shading does not read them: on
/// lavapipe 22.3 each draw into a storage image that is bound waits for the draw before.
constexpr std::span kBindings = std::span(kKeepBindings).first<kCells>();

/// Nobody has seen it: lib/interleaved.glsl, seen_of().
constexpr std::array kUnseen{0.0F, 0.0F, 0.0F, 0.0F};

/// Constants of the shaders (shaders/lib/interleaved.glsl, shaders/resolve/interleaved_keep.frag).
enum InterleavedConstant : std::uint32_t {
    kTexelBlockWidth = kOfMethod,
    kTexelBlockHeight,
    kPixelBlockWidth,
    kPixelBlockHeight,
    kFollows,
    kPixels,
    kHeld = kPixels + 2,  // kJittered lies between
    kSharp,
};

/// The grids of a plan.
enum Grid : std::size_t { kOfTexels, kOfPixels, kGrids };
constexpr std::array kEveryGrid{kOfTexels, kOfPixels};

/// std140, shaders/lib/interleaved.glsl.
struct InterleavedUniforms {
    glm::vec4 cells{0.0F};
    glm::vec4 first_bands{0.0F};
    glm::vec4 refill_bands{0.0F};
    glm::vec4 before{0.0F};
    std::array<glm::vec4, kGrids> kept{};
    glm::vec4 map_before{0.0F};
    std::array<glm::vec4, foveation::CellTurns::kMost> turns{};
    std::array<glm::vec4, foveation::CellTurns::kMost> layers{};
    std::array<glm::vec4, kMaxSamples> texel_offsets{};
    std::array<glm::vec4, kMaxSamples> pixel_offsets{};
};
static_assert(sizeof(InterleavedUniforms) ==
              16 * (std::size_t{7} + 2 * std::size_t{foveation::CellTurns::kMost} +
                    2 * std::size_t{kMaxSamples}));

constexpr std::size_t kMapVectors = sizeof(MapUniforms) / sizeof(glm::vec4);

/// Sample positions of one visit: those of every frame, moved together along a sequence that fills
/// the cell evenly (Roberts's R2), and back in where they leave it.
std::array<glm::dvec2, kMaxSamples> visit_offsets(std::uint32_t samples, std::uint64_t visit) {
    constexpr glm::dvec2 kStep(0.7548776662466927, 0.5698402909980532);
    constexpr std::uint64_t kPeriod = 1024;  // so that products stay exact enough
    const glm::dvec2 moved = kStep * static_cast<double>(visit % kPeriod);
    auto offsets = sample_offsets(samples);
    for (std::size_t s = 0; visit > 0 && s < samples; ++s) {
        const glm::dvec2 at = offsets[s] + moved + 0.5;
        offsets[s] = at - glm::floor(at) - 0.5;
    }
    return offsets;
}

class InterleavedPasses final : public PlannedPasses<InterleavedPlan> {
  public:
    InterleavedPasses(const PassSetup& setup, const InterleavedConfig& config,
                      const foveation::KfrParameters& parameters)
        : PlannedPasses(
              frame::PassList{"pass_i", "disc", "keep", "resolve"},
              std::make_unique<InterleavedPlan>(std::make_unique<foveation::KfrPlan>(parameters),
                                                config.texels, config.pixels, config.refill)),
          setup_(setup),
          config_(config) {
        const vk::raii::Device& device = setup.context.device();
        layouts_ = Layouts(setup, kBindings);
        keep_layouts_ = Layouts(setup, kKeepBindings);
        make_pipelines();
        const std::uint32_t sets = 3 * setup.slots * static_cast<std::uint32_t>(gaze::kEyeCount);
        const std::array sizes{vk::DescriptorPoolSize(Type::eUniformBuffer, 3 * sets),
                               vk::DescriptorPoolSize(Type::eStorageBuffer, 3 * sets),
                               vk::DescriptorPoolSize(Type::eStorageImage, 4 * sets)};
        pool_ = vk::raii::DescriptorPool(
            device, vk::DescriptorPoolCreateInfo(
                        vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, sets, sizes));
        slots_.resize(setup.slots);
        for (auto& slot : slots_) {
            for (EyeSlot& at : slot) {
                constexpr auto kUniform = vk::BufferUsageFlagBits::eUniformBuffer;
                at.map = vulkan::HostBuffer(setup.context, sizeof(MapUniforms), kUniform);
                at.uniforms =
                    vulkan::HostBuffer(setup.context, sizeof(InterleavedUniforms), kUniform);
                at.shade_set = allocate(layouts_);
                at.keep_set = allocate(keep_layouts_);
                at.resolve_set = allocate(layouts_);
            }
        }
    }

    void record_after_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame,
                           const gaze::PerEye<foveation::EyePlan>& plans) override {
        // Sets may not change once commands have bound them.
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            advance(frame, e, plans[e]);
        }
        const auto any = [&](std::size_t grid) {
            return !plans[0].grids[grid].tiles.empty() || !plans[1].grids[grid].tiles.empty();
        };
        const auto shade = [&](const vk::raii::CommandBuffer& commands, std::size_t grid) {
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                shade_grid(commands, frame, e, grid, plans[e]);
            }
        };
        if (any(kOfTexels)) {
            shade(recorder.begin("pass_i"), kOfTexels);
        }
        if (any(kOfPixels)) {
            shade(recorder.begin("disc"), kOfPixels);
        }
        const vk::raii::CommandBuffer& keeping = recorder.begin("keep");
        for (const std::size_t grid : kEveryGrid) {
            // A grid without any cell is not submitted for itself; what it has to prepare goes
            // along.
            if (!any(grid)) {
                shade(keeping, grid);
            }
        }
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            for (const std::size_t grid : kEveryGrid) {
                keep(keeping, frame, e, grid, plans[e]);
            }
            eyes_[e].map_before = foveation::map_uniforms_of(plans[e]);
        }
        const vk::raii::CommandBuffer& commands = recorder.begin("resolve");
        draw_pictures(commands, frame, setup_, [&](std::size_t e) {
            bind_sets(commands, layouts_.pipeline, frame, e, *slots_[frame.slot][e].resolve_set);
            draw_resolve(commands, e, plans[e], frame.view.hidden[e].get());
        });
    }

  private:
    /// Of set 2, and of pipelines with it.
    struct Layouts {
        Layouts() = default;
        Layouts(const PassSetup& setup, std::span<const Type> bindings)
            : set(vulkan::make_set_layout(setup.context.device(), bindings,
                                          vk::ShaderStageFlagBits::eFragment)),
              pipeline(vulkan::make_pipeline_layout(
                  setup.context.device(), {setup.frame_layout, setup.scene.inputs(), *set},
                  setup.empty_layout)) {}

        vk::raii::DescriptorSetLayout set{nullptr};
        vk::raii::PipelineLayout pipeline{nullptr};
    };

    [[nodiscard]] vk::raii::DescriptorSet allocate(const Layouts& layouts) const {
        return std::move(vk::raii::DescriptorSets(
            setup_.context.device(), vk::DescriptorSetAllocateInfo(*pool_, *layouts.set))[0]);
    }

    /// What an eye keeps from frame to frame.
    struct Eye {
        std::optional<MapBuffers> map;
        std::array<vulkan::History, kGrids> kept;
        std::array<vulkan::TrackedColorImage, kGrids> cells;
        MapUniforms map_before;
        std::array<foveation::Tile, kGrids> kept_within;  ///< the last frame's rectangles
        bool any_before = false;  ///< something is kept for the frame at hand
    };

    /// What a frame owns until the GPU has finished it.
    struct EyeSlot {
        vulkan::HostBuffer map;
        vulkan::HostBuffer uniforms;
        vulkan::HostBuffer bands;
        vk::raii::DescriptorSet shade_set{nullptr};
        vk::raii::DescriptorSet keep_set{nullptr};
        vk::raii::DescriptorSet resolve_set{nullptr};
    };

    [[nodiscard]] const foveation::CellTurns& turns(std::size_t grid) const {
        return grid == kOfPixels ? config_.pixels : config_.texels;
    }

    [[nodiscard]] InterleavedPlan::Bands bands_of(std::size_t e,
                                                  const foveation::EyePlan& made) const {
        return plan().bands_of(made, gaze::kEyes.at(e), setup_.extents[e].height);
    }

    /// Texels or pixels of a grid.
    [[nodiscard]] vk::Extent2D extent(std::size_t e, std::size_t grid) const {
        const foveation::LpSize lp = plan().whole().lp(gaze::kEyes.at(e));
        return grid == kOfPixels ? setup_.extents[e] : vk::Extent2D(lp.width, lp.height);
    }
    [[nodiscard]] vk::Extent2D cells(std::size_t e, std::size_t grid) const {
        const vk::Extent2D whole = extent(e, grid);
        return {turns(grid).columns(whole.width), turns(grid).rows(whole.height)};
    }

    void attach() override {
        const vk::raii::Device& device = setup_.context.device();
        for (const gaze::Eye eye : gaze::kEyes) {
            const std::size_t e = gaze::index(eye);
            Eye& at = eyes_[e];
            at = {};
            at.map.emplace(setup_.context, plan().whole().tables(eye), setup_.samples,
                           plan().whole().lp(eye).height);
            std::size_t bands = 0;
            for (const std::size_t grid : kEveryGrid) {
                using Usage = vk::ImageUsageFlagBits;
                at.kept.at(grid) =
                    vulkan::History(setup_.context, extent(e, grid), kKeptFormat, Usage::eStorage);
                // A layer of them for each turn, side by side as in a block.
                const vk::Extent2D layers(cells(e, grid).width * turns(grid).block_width(),
                                          cells(e, grid).height * turns(grid).block_height());
                at.cells.at(grid) = {setup_.context, layers, kKeptFormat,
                                     Usage::eColorAttachment | Usage::eStorage};
                bands += 2 * std::size_t{InterleavedPlan::bands(cells(e, grid).height)} +
                         InterleavedPlan::bands(extent(e, grid).height);
            }
            for (auto& slot : slots_) {
                slot[e].bands =
                    vulkan::HostBuffer(setup_.context, bands * sizeof(foveation::Columns),
                                       vk::BufferUsageFlagBits::eStorageBuffer);
                const vk::DescriptorBufferInfo info(slot[e].uniforms.buffer(), 0, VK_WHOLE_SIZE);
                for (const vk::DescriptorSet set :
                     {*slot[e].shade_set, *slot[e].keep_set, *slot[e].resolve_set}) {
                    write_map(device, set, slot[e].map.buffer(), *at.map, slot[e].bands.buffer());
                    device.updateDescriptorSets(
                        vk::WriteDescriptorSet(set, kUniforms, 0, Type::eUniformBuffer, {}, info),
                        {});
                }
                for (const std::size_t grid : kEveryGrid) {
                    write_storage_image(device, *slot[e].keep_set,
                                        kCells + static_cast<std::uint32_t>(grid),
                                        at.cells.at(grid).image.view());
                }
            }
        }
    }

    void make_pipelines() {
        const vk::raii::Device& device = setup_.context.device();
        const std::array weaving{
            vulkan::ShaderConstant{kTexelBlockWidth, config_.texels.block_width()},
            vulkan::ShaderConstant{kTexelBlockHeight, config_.texels.block_height()},
            vulkan::ShaderConstant{kPixelBlockWidth, config_.pixels.block_width()},
            vulkan::ShaderConstant{kPixelBlockHeight, config_.pixels.block_height()},
            vulkan::ShaderConstant{kFollows, config_.follow ? 1U : 0U}};
        auto shading = with_scene(setup_.scene, {{kSamples, setup_.samples}});
        shading.insert(shading.end(), weaving.begin(), weaving.end());
        shade_ = vulkan::make_pipeline(
            device, layouts_.pipeline,
            {.vertex = "tiles.vert",
             .fragment = fmt::format("{}.interleaved.frag", setup_.scene.shader()),
             .format = kKeptFormat,
             .constants = shading});
        for (const std::size_t grid : kEveryGrid) {
            std::vector<vulkan::ShaderConstant> keeping(weaving.begin(), weaving.end());
            keeping.push_back({kPixels, grid == kOfPixels ? 1U : 0U});
            keeping.push_back({kHeld, config_.hold ? 1U : 0U});
            const bool sharp =
                config_.sharp == InterleavedConfig::Sharp::All ||
                (config_.sharp == InterleavedConfig::Sharp::Disc && grid == kOfPixels);
            keeping.push_back({kSharp, sharp ? 1U : 0U});
            keep_.at(grid) = vulkan::make_pipeline(device, keep_layouts_.pipeline,
                                                   {.vertex = "full_screen.vert",
                                                    .fragment = "interleaved_keep.frag",
                                                    .format = kKeptFormat,
                                                    .constants = keeping});
        }
        for (const std::uint32_t disc : {0U, 1U}) {
            const std::array resolving{
                vulkan::ShaderConstant{kEncodeSrgb, takes_linear(setup_.format) ? 0U : 1U},
                vulkan::ShaderConstant{kWithDisc, disc}};
            resolve_.at(disc) =
                vulkan::make_pipeline(device, layouts_.pipeline,
                                      {.vertex = "full_screen.vert",
                                       .fragment = resolve_shader("interleaved", setup_),
                                       .format = setup_.format,
                                       .depth_format = setup_.depth_format,
                                       .constants = resolving});
        }
    }

    /// Begins a frame of an eye's histories, and tells the shaders of it.
    void advance(const FrameRecording& frame, std::size_t e, const foveation::EyePlan& plan) {
        Eye& eye = eyes_[e];
        const bool follows = frame.in_run.before[e].has_value();
        eye.any_before = follows;
        const EyeSlot& at = slots_[frame.slot][e];
        const vk::raii::Device& device = setup_.context.device();
        for (const std::size_t grid : kEveryGrid) {
            vulkan::History& kept = eye.kept.at(grid);
            if (!follows) {
                kept.reset();
            }
            kept.advance();
            const auto number = static_cast<std::uint32_t>(grid);
            const vk::ImageView before = kept.other().image.view();
            write_storage_image(device, *at.shade_set, kKept + number, before);
            write_storage_image(device, *at.keep_set, kKept + number, before);
            write_storage_image(device, *at.resolve_set, kKept + number, kept.now().image.view());
        }
        write_uniforms(frame, e, plan);
    }

    void write_uniforms(const FrameRecording& frame, std::size_t e,
                        const foveation::EyePlan& plan) {
        const Eye& eye = eyes_[e];
        EyeSlot& at = slots_[frame.slot][e];
        at.map.write(std::span(plan.uniforms).first(kMapVectors));
        InterleavedUniforms told;
        const auto vector = [](auto x, auto y, auto z, auto w) {
            return glm::vec4(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z),
                             static_cast<float>(w));
        };
        tell_turns(frame.in_run.index, told);
        const vk::Extent2D texel_cells = cells(e, kOfTexels);
        const vk::Extent2D pixel_cells = cells(e, kOfPixels);
        told.cells =
            vector(texel_cells.width, texel_cells.height, pixel_cells.width, pixel_cells.height);
        // Cells of texels, of pixels; blocks of both that are shaded whole; texels and pixels.
        const InterleavedPlan::Bands bands = bands_of(e, plan);
        const std::span<const std::uint32_t> read(bands.texels.begin(), bands.pixels.end());
        const std::size_t of_pixel_cells = InterleavedPlan::bands(texel_cells.height);
        const std::size_t of_texel_refill =
            of_pixel_cells + InterleavedPlan::bands(pixel_cells.height);
        const std::size_t of_pixel_refill = of_texel_refill + bands.texel_refill.size() / 2;
        const std::size_t of_texels = of_pixel_refill + bands.pixel_refill.size() / 2;
        const std::size_t texel_bands = InterleavedPlan::bands(extent(e, kOfTexels).height);
        told.refill_bands = vector(of_texel_refill, of_pixel_refill, 0, 0);
        told.first_bands = vector(of_pixel_cells, of_texels, of_texels + texel_bands, 0);
        told.before = vector(eye.any_before ? 1 : 0, config_.visits, 0, 0);
        const auto write_bands = [&](std::size_t first, std::span<const std::uint32_t> words) {
            at.bands.write(words, first * sizeof(foveation::Columns));
        };
        const auto write_cells = [&](std::size_t first, std::size_t count, std::size_t grid) {
            static constexpr foveation::Columns kNone{};
            const auto& planned = plan.grids[grid].bands;
            for (std::size_t band = 0; band < count; ++band) {
                at.bands.write(std::span(band < planned.size() ? &planned[band] : &kNone, 1),
                               (first + band) * sizeof(foveation::Columns));
            }
        };
        write_cells(0, of_pixel_cells, kOfTexels);
        write_cells(of_pixel_cells, of_texel_refill - of_pixel_cells, kOfPixels);
        write_bands(of_texel_refill, bands.texel_refill);
        write_bands(of_pixel_refill, bands.pixel_refill);
        write_bands(of_texels, read);
        for (const std::size_t grid : kEveryGrid) {
            const foveation::Tile& kept = eye.kept_within.at(grid);
            told.kept.at(grid) = vector(kept.x0, kept.y0, kept.x1, kept.y1);
        }
        // Where nothing is kept, this frame's stands in: the shaders compute with it all the same.
        const MapUniforms before =
            eye.any_before ? eye.map_before : foveation::map_uniforms_of(plan);
        told.map_before = {before.fovea_and_log2.x, before.fovea_and_log2.y,
                           before.radius_and_bands.y, before.fovea_and_log2.w};
        const auto offsets = [&](std::size_t grid) {
            return visit_offsets(setup_.samples,
                                 config_.jitter ? frame.in_run.index / turns(grid).every : 0);
        };
        const auto of_texel = offsets(kOfTexels);
        const auto of_pixel = offsets(kOfPixels);
        const double row_rad = 2.0 * std::numbers::pi / extent(e, kOfTexels).height;
        for (std::size_t s = 0; s < setup_.samples; ++s) {
            const double turned_rad = of_texel[s].y * row_rad;
            told.texel_offsets[s] =
                vector(of_texel[s].x, of_texel[s].y, std::cos(turned_rad), std::sin(turned_rad));
            told.pixel_offsets[s] = vector(of_pixel[s].x, of_pixel[s].y, 0, 0);
        }
        at.uniforms.write(told);
    }

    /// The turns of a frame: its own, which is layer 0, and those before it, whose places are
    /// shaded as well where a block is shaded whole.
    void tell_turns(std::uint64_t frame, InterleavedUniforms& told) const {
        for (const std::size_t grid : kEveryGrid) {
            const foveation::CellTurns& taken = turns(grid);
            for (std::uint32_t layer = 0; layer < taken.every; ++layer) {
                const foveation::CellTurns::Place place = taken.place(frame + taken.every - layer);
                const auto at = static_cast<glm::length_t>(2 * grid);
                told.turns.at(layer)[at] = static_cast<float>(place.x);
                told.turns.at(layer)[at + 1] = static_cast<float>(place.y);
                told.layers.at(place.y * taken.block_width() +
                               place.x)[static_cast<glm::length_t>(grid)] =
                    static_cast<float>(layer);
            }
        }
    }

    /// The tiles of what a table has, on a side of so many rows.
    std::span<foveation::Tile> tiles_of(std::span<const std::uint32_t> words, std::uint32_t rows) {
        told_bands_.clear();
        for (std::size_t word = 0; word < words.size(); word += 2) {
            told_bands_.push_back({words[word], words[word + 1]});
        }
        told_tiles_.clear();
        append_band_tiles(told_bands_, rows, told_tiles_);
        return told_tiles_;
    }

    /// The tiles of blocks that are shaded whole, where a turn's cells lie in the image.
    std::span<const foveation::Tile> refill_tiles(std::size_t e, std::size_t grid,
                                                  std::span<const std::uint32_t> words,
                                                  std::uint32_t layer) {
        const vk::Extent2D size = cells(e, grid);
        const std::uint32_t across = turns(grid).block_width();
        const std::span<foveation::Tile> tiles = tiles_of(words, size.height);
        for (foveation::Tile& tile : tiles) {
            tile.x0 += layer % across * size.width;
            tile.x1 += layer % across * size.width;
            tile.y0 += layer / across * size.height;
            tile.y1 += layer / across * size.height;
        }
        return tiles;
    }

    /// Shades cells of a grid and makes them readable.
    void shade_grid(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                    std::size_t e, std::size_t grid, const foveation::EyePlan& plan) {
        Eye& eye = eyes_[e];
        for (vulkan::History& kept : eye.kept) {
            kept.other().tracked.use(
                commands, vulkan::Use::Loaded,
                eye.any_before ? vulkan::Keep::Content : vulkan::Keep::Nothing);
        }
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *shade_);
        bind_sets(commands, layouts_.pipeline, frame, e, *slots_[frame.slot][e].shade_set);
        vulkan::TrackedColorImage& cells = eye.cells.at(grid);
        cells.tracked.use(commands, vulkan::Use::ColorTarget, vulkan::Keep::Nothing);
        const std::span<const foveation::Tile> tiles = plan.grids[grid].tiles;
        if (!tiles.empty() || setup_.unshaded) {
            const InterleavedPlan::Bands bands = bands_of(e, plan);
            begin_rendering(
                commands, cells.image.view(), cells.image.extent(),
                setup_.unshaded ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eDontCare,
                setup_.unshaded.value_or(std::array<float, 4>{}));
            const std::uint32_t of_grid = grid == kOfPixels ? 1 : 0;
            draw_tiles(commands, tiles, of_grid);
            for (std::uint32_t layer = 1; layer < turns(grid).every; ++layer) {
                draw_tiles(commands,
                           refill_tiles(e, grid,
                                        grid == kOfPixels ? bands.pixel_refill : bands.texel_refill,
                                        layer),
                           2 * layer + of_grid);
            }
            commands.endRendering();
        }
        cells.tracked.use(commands, vulkan::Use::Loaded);
    }

    /// A grid's texels or pixels that the picture reads.
    std::span<const foveation::Tile> needed(std::size_t e, std::size_t grid,
                                            const foveation::EyePlan& plan) {
        const InterleavedPlan::Bands bands = bands_of(e, plan);
        return tiles_of(grid == kOfTexels ? bands.texels : bands.pixels, extent(e, grid).height);
    }

    /// The rectangle of those.
    foveation::Tile rectangle(std::size_t e, std::size_t grid, const foveation::EyePlan& plan) {
        foveation::Tile all{.x0 = ~0U, .y0 = ~0U};
        for (const foveation::Tile& tile : needed(e, grid, plan)) {
            all = {std::min(all.x0, tile.x0), std::min(all.y0, tile.y0), std::max(all.x1, tile.x1),
                   std::max(all.y1, tile.y1)};
        }
        return all.x0 < all.x1 ? all : foveation::Tile{};
    }

    /// Weaves a grid's cells into what was kept.
    void keep(const vk::raii::CommandBuffer& commands, const FrameRecording& frame, std::size_t e,
              std::size_t grid, const foveation::EyePlan& plan) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *keep_.at(grid));
        bind_sets(commands, keep_layouts_.pipeline, frame, e, *slots_[frame.slot][e].keep_set);
        Eye& eye = eyes_[e];
        eye.kept_within.at(grid) = rectangle(e, grid, plan);
        // Within the rectangle what is not needed tells so by what it holds. The LP-buffer's part
        // that is off screen is cheaper cleared than drawn, that beside the disc drawn.
        const bool texels = grid == kOfTexels;
        const foveation::Tile& within = eye.kept_within.at(grid);
        const std::span<const foveation::Tile> disc(&within, within.x0 < within.x1 ? 1 : 0);
        shade_cells(commands, eye.kept.at(grid).now(), texels ? needed(e, grid, plan) : disc, 0,
                    texels ? setup_.unshaded.value_or(kUnseen) : setup_.unshaded,
                    vulkan::Use::Loaded);
    }

    /// The whole picture from the LP-buffer, then the disc over it.
    void draw_resolve(const vk::raii::CommandBuffer& commands, std::size_t e,
                      const foveation::EyePlan& plan, const foveation::HiddenArea* hidden) {
        if (!plan.grids[kOfTexels].tiles.empty()) {
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *resolve_[0]);
            draw_visible(commands, hidden);
        }
        if (const auto disc = needed(e, kOfPixels, plan); !disc.empty()) {
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *resolve_[1]);
            // Hidden pixels of the disc were not shaded: what lies in their places must not show.
            draw_visible_tiles(commands, disc, hidden);
        }
    }

    PassSetup setup_;
    InterleavedConfig config_;
    Layouts layouts_;
    Layouts keep_layouts_;
    vk::raii::Pipeline shade_{nullptr};
    std::array<vk::raii::Pipeline, kGrids> keep_{nullptr, nullptr};
    std::array<vk::raii::Pipeline, 2> resolve_{nullptr, nullptr};  ///< without and with the disc
    vk::raii::DescriptorPool pool_{nullptr};
    gaze::PerEye<Eye> eyes_;
    std::vector<gaze::PerEye<EyeSlot>> slots_;
    std::vector<foveation::Columns> told_bands_;  ///< of the table at hand
    std::vector<foveation::Tile> told_tiles_;
};

}  // namespace

std::unique_ptr<MethodPasses> make_interleaved_passes(const PassSetup& setup,
                                                      const InterleavedConfig& config,
                                                      const foveation::KfrParameters& parameters) {
    for (const vk::Extent2D extent : setup.extents) {
        // Checked now, not with the first frame, because it does not depend on the fields of view.
        (void)value_or_throw(foveation::lp_buffer_size(parameters, {extent.width, extent.height}));
    }
    return std::make_unique<InterleavedPasses>(setup, config, parameters);
}

}  // namespace gazeloop::render
