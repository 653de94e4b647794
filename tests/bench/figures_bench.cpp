#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "runtime/render/snapshot.h"
#include "tests/bench/bench.h"
#include "tests/bench/raycast_setup.h"

namespace gazeloop::bench {
namespace {

constexpr double kHalfWidth_rad = 0.6;
constexpr std::uint32_t kGap_px = 4;
/// Of a side of the picture that a zoomed view shows.
constexpr std::uint32_t kZoom = 4;

/// A sheet of pictures in rows.
class Sheet {
  public:
    Sheet(std::uint32_t columns, std::uint32_t rows, vk::Extent2D tile) : tile_(tile) {
        picture_.width = columns * (tile.width + kGap_px) - kGap_px;
        picture_.height = rows * (tile.height + kGap_px) - kGap_px;
        picture_.pixels.assign(std::size_t{picture_.width} * picture_.height, {255, 255, 255});
    }

    /// The part of a picture that begins at (x0, y0), as large as fits, every pixel drawn `zoom`
    /// times as wide and high.
    void put(std::uint32_t column, std::uint32_t row, const render::Picture& from,
             std::uint32_t x0 = 0, std::uint32_t y0 = 0, std::uint32_t zoom = 1) {
        const std::size_t left = std::size_t{column} * (tile_.width + kGap_px);
        const std::size_t top = std::size_t{row} * (tile_.height + kGap_px);
        for (std::uint32_t y = 0; y < tile_.height && y0 + y / zoom < from.height; ++y) {
            for (std::uint32_t x = 0; x < tile_.width && x0 + x / zoom < from.width; ++x) {
                picture_.pixels[(top + y) * picture_.width + left + x] =
                    from.pixels[std::size_t{y0 + y / zoom} * from.width + x0 + x / zoom];
            }
        }
    }

    void write(const std::filesystem::path& file) const {
        value_or_throw(render::write_png(picture_, file));
        fmt::print(stderr, "{}\n", file.string());
    }

  private:
    vk::Extent2D tile_;
    render::Picture picture_;
};

/// The pictures of a paper's figures: one eye, gaze in the middle, the gallery of meshes. By the
/// map alone, as the paper has it: no pixel is shaded directly, so that its fovea shows.
class FigurePictures {
  public:
    explicit FigurePictures(const vulkan::Context& context)
        : context_(context),
          scene_(scene::make_scene(context, "gallery")),
          setup_(context, kExtent, kHalfWidth_rad),
          full_(of(render::Method::Full, 1.8, 4.0).picture) {}

    static constexpr vk::Extent2D kExtent{640, 360};

    struct Foveated {
        render::Picture picture;
        render::Picture lp;  ///< empty for full resolution
    };
    [[nodiscard]] Foveated of(render::Method method, double sigma, double alpha) const {
        render::MethodConfig config = setup_.config({.samples = 1});
        config.method = method;
        config.kfr.sigma = sigma;
        config.kfr.kernel = alpha;
        config.kfr.disc = false;
        // For both eyes: the other one's picture is too small for a share of it.
        config.kfr.lp_width = static_cast<std::uint32_t>(std::lround(kExtent.width / sigma));
        config.kfr.lp_height = static_cast<std::uint32_t>(std::lround(kExtent.height / sigma));
        render::OffScreen off_screen(context_, *scene_, render::passes_of(config), config);
        const render::FrameRequest request = setup_.frame(0.0, fovea());
        off_screen.render(request.frame_view(), request.fovea());
        Foveated made{.picture = off_screen.picture(gaze::Eye::Left), .lp = {}};
        for (const render::BufferPicture& buffer : off_screen.renderer().buffers(gaze::Eye::Left)) {
            made.lp = render::picture_of(context_, buffer);
        }
        return made;
    }
    [[nodiscard]] Foveated kfr(double sigma, double alpha) const {
        return of(render::Method::Kfr, sigma, alpha);
    }
    [[nodiscard]] const render::Picture& full() const { return full_; }
    [[nodiscard]] gaze::PixelPosition fovea() const { return setup_.centre(); }

    /// Mean absolute difference from full resolution, codes of 255.
    [[nodiscard]] double error(const render::Picture& picture) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                sum += std::abs(picture.pixels[i][c] - full_.pixels[i][c]);
            }
        }
        return sum / static_cast<double>(3 * picture.pixels.size());
    }

  private:
    const vulkan::Context& context_;
    std::unique_ptr<scene::Scene> scene_;
    RaycastSetup setup_;
    render::Picture full_;
};

/// Where a zoomed view begins: around the fovea, and in the lower right, far from it.
struct Corner {
    std::uint32_t x, y;
};
constexpr Corner kFoveal{(640 - 640 / kZoom) / 2, (360 - 360 / kZoom) / 2};
constexpr Corner kPeripheral{640 - 640 / kZoom - 16, 360 - 360 / kZoom - 16};

}  // namespace

std::vector<Figure> paper_figures(const Options& /*options*/) {
    const vulkan::Context context({}, nullptr);
    const FigurePictures pictures(context);
    const std::filesystem::path folder = std::filesystem::path(GAZELOOP_BINARY_DIR) / "figures";
    std::filesystem::create_directories(folder);
    std::vector<Figure> figures;
    const auto add = [&](std::string name, const render::Picture& picture) {
        figures.push_back({.bench = "figures",
                           .name = std::move(name),
                           .metric = "error",
                           .value = pictures.error(picture),
                           .unit = "code",
                           .better = "lower"});
    };
    const vk::Extent2D tile = FigurePictures::kExtent;
    const auto put_zoomed = [](Sheet& sheet, std::uint32_t column, std::uint32_t row,
                               const render::Picture& from,
                               Corner at) { sheet.put(column, row, from, at.x, at.y, kZoom); };
    {
        // Rows: the full picture, then alpha 1 to 6. Columns: whole, at the fovea, far from it.
        Sheet sheet(3, 7, tile);
        for (std::uint32_t row = 0; row < 7; ++row) {
            const render::Picture shown =
                row == 0 ? pictures.full() : pictures.kfr(1.8, row).picture;
            sheet.put(0, row, shown);
            put_zoomed(sheet, 1, row, shown, kFoveal);
            put_zoomed(sheet, 2, row, shown, kPeripheral);
            if (row > 0) {
                add(fmt::format("alpha {}", row), shown);
            }
        }
        sheet.write(folder / "figure-4.png");
    }
    // Columns: the full picture, the LP-buffer, what comes of it, and that far from the fovea.
    const auto write_rows = [&](std::span<const std::pair<double, double>> parameters,
                                std::string_view name) {
        Sheet sheet(4, static_cast<std::uint32_t>(parameters.size()), tile);
        for (std::uint32_t row = 0; row < parameters.size(); ++row) {
            const auto& [sigma, alpha] = parameters[row];
            const FigurePictures::Foveated made = pictures.kfr(sigma, alpha);
            sheet.put(0, row, pictures.full());
            sheet.put(1, row, made.lp);
            sheet.put(2, row, made.picture);
            put_zoomed(sheet, 3, row, made.picture, kPeripheral);
        }
        sheet.write(folder / name);
    };
    write_rows(std::array{std::pair{1.8, 1.0}, std::pair{1.8, 2.0}, std::pair{1.8, 3.0},
                          std::pair{1.8, 4.0}},
               "figure-6.png");
    const std::array sigmas{std::pair{1.2, 4.0}, std::pair{1.8, 4.0}, std::pair{2.4, 4.0}};
    write_rows(sigmas, "figure-7.png");
    for (const auto& [sigma, alpha] : sigmas) {
        add(fmt::format("sigma {}", sigma), pictures.kfr(sigma, alpha).picture);
    }
    return figures;
}

}  // namespace gazeloop::bench
