#include "runtime/foveation/plans/sparse_pattern.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string_view>

namespace gazeloop::foveation {
namespace {

constexpr std::uint32_t kMaxSide = 16384;

Expected<void> check(std::string_view what, double value, double least, double greatest) {
    if (!(value >= least && value <= greatest)) {  // true for NaN
        return std::unexpected(Error{
            ErrorKind::Usage,
            fmt::format("sparse.{} = {}: must lie in [{}, {}]", what, value, least, greatest)});
    }
    return {};
}

Expected<void> check(const SparseParameters& p, ImageSize image) {
    using P = SparseParameters;
    for (const auto& checked :
         {check("share", p.share, P::kMinShare, P::kMaxShare),
          check("disc_share", p.disc_share, 0.0, 0.9),
          check("narrow_share", p.narrow_share, 0.0, 1.0),
          check("narrow_spread", p.narrow_spread, P::kMinSpread, P::kMaxSpread),
          check("wide_spread", p.wide_spread, P::kMinSpread, P::kMaxSpread)}) {
        if (!checked) {
            return checked;
        }
    }
    if (image.width_px < 1 || image.height_px < 1 || image.width_px > kMaxSide ||
        image.height_px > kMaxSide) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("a picture of {}x{} px cannot be sampled sparsely: each side must "
                              "have 1 to {} px",
                              image.width_px, image.height_px, kMaxSide)});
    }
    return {};
}

/// A place in the field, in pixels; floor gives its pixel.
struct Place {
    double x = 0.0;
    double y = 0.0;

    [[nodiscard]] FieldPixel pixel() const {
        return {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
    }
};

/// Places, found by cells. Places are not whole pixels: near the disc, samples are about as close
/// as pixels, and distances in whole pixels are too coarse to space them by.
class Spacing {
  public:
    explicit Spacing(ImageSize field)
        : columns_(field.width_px / kCellPx + 1),
          rows_(field.height_px / kCellPx + 1),
          first_(std::size_t{columns_} * rows_, kNone) {}

    [[nodiscard]] bool any_within(const Place& place, double distance_px) const {
        const auto cells = [&](double position, std::uint32_t count) {
            const double low = std::floor((position - distance_px) / kCellPx);
            const double high = std::floor((position + distance_px) / kCellPx);
            return std::pair{static_cast<std::uint32_t>(std::max(low, 0.0)),
                             static_cast<std::uint32_t>(std::min(high, count - 1.0))};
        };
        const auto [x0, x1] = cells(place.x, columns_);
        const auto [y0, y1] = cells(place.y, rows_);
        for (std::uint32_t y = y0; y <= y1; ++y) {
            for (std::uint32_t x = x0; x <= x1; ++x) {
                for (std::uint32_t i = first_[std::size_t{y} * columns_ + x]; i != kNone;
                     i = entries_[i].next) {
                    const double dx = entries_[i].place.x - place.x;
                    const double dy = entries_[i].place.y - place.y;
                    if (dx * dx + dy * dy < distance_px * distance_px) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

    void add(const Place& place) {
        const FieldPixel pixel = place.pixel();
        std::uint32_t& first =
            first_[std::size_t{pixel.y / kCellPx} * columns_ + pixel.x / kCellPx];
        entries_.push_back({place, first});
        first = static_cast<std::uint32_t>(entries_.size() - 1);
    }

  private:
    static constexpr std::uint32_t kCellPx = 8;
    static constexpr std::uint32_t kNone = UINT32_MAX;
    struct Entry {
        Place place;
        std::uint32_t next;
    };

    std::uint32_t columns_;
    std::uint32_t rows_;
    std::vector<std::uint32_t> first_;
    std::vector<Entry> entries_;
};

class PatternMaker {
  public:
    PatternMaker(const SparseParameters& parameters, ImageSize image)
        : parameters_(parameters),
          pattern_{.image = image, .profile = {}, .samples = {}},
          random_(parameters.seed),
          taken_(std::size_t{pattern_.field().width_px} * pattern_.field().height_px) {
        const std::uint64_t pixels = std::uint64_t{image.width_px} * image.height_px;
        target_ = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(
                                                 parameters.share * static_cast<double>(pixels))));
        const double diagonal = std::hypot(image.width_px, image.height_px);
        SparseProfile& profile = pattern_.profile;
        profile.narrow_px = parameters.narrow_spread * diagonal;
        profile.wide_px = parameters.wide_spread * diagonal;
        profile.disc_radius_px = std::min(
            std::sqrt(parameters.disc_share * static_cast<double>(target_) / std::numbers::pi),
            0.5 * std::min(image.width_px, image.height_px));
        if (target_ == pixels) {
            profile.disc_radius_px = diagonal;  // every pixel of the field, wherever the gaze is
            taken_.assign(taken_.size(), true);
            in_picture_ = target_;
        }
    }

    Expected<SparsePattern> make() {
        if (in_picture_ < target_) {
            take_disc();
        }
        const std::vector<bool> only_disc = taken_;
        const std::uint64_t disc_in_picture = in_picture_;
        if (const auto taken = take_draws(); !taken) {
            return std::unexpected(taken.error());
        }
        if (parameters_.placement == SparsePlacement::BlueNoise) {
            taken_ = only_disc;
            in_picture_ = disc_in_picture;
            take_spaced();
        }
        const ImageSize field = pattern_.field();
        for (std::uint32_t y = 0; y < field.height_px; ++y) {
            for (std::uint32_t x = 0; x < field.width_px; ++x) {
                if (taken_[std::size_t{y} * field.width_px + x]) {
                    pattern_.samples.push_back(
                        {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
                }
            }
        }
        return std::move(pattern_);
    }

  private:
    /// [0, 1) in steps of 2^-53; the standard's own distributions differ between libraries.
    double uniform() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }

    std::size_t index(const FieldPixel& pixel) const {
        return std::size_t{pixel.y} * pattern_.field().width_px + pixel.x;
    }

    /// Distance of a pixel's centre from the gaze, the field's middle.
    [[nodiscard]] double radius_px(const FieldPixel& pixel) const {
        return std::hypot(pixel.x + 0.5 - pattern_.image.width_px,
                          pixel.y + 0.5 - pattern_.image.height_px);
    }

    void take(const FieldPixel& pixel) {
        taken_[index(pixel)] = true;
        const ImageSize& image = pattern_.image;
        // The picture's window for a gaze at its centre, as SparsePattern::window has it.
        const FieldPixel origin = pattern_.window({image.width_px / 2.0, image.height_px / 2.0});
        if (pixel.x >= origin.x && pixel.x < origin.x + image.width_px && pixel.y >= origin.y &&
            pixel.y < origin.y + image.height_px) {
            ++in_picture_;
        }
    }

    void take_disc() {
        const double radius = pattern_.profile.disc_radius_px;
        const auto reach = static_cast<std::uint32_t>(std::ceil(radius));
        const ImageSize& image = pattern_.image;
        for (std::uint32_t y = image.height_px - std::min(reach, image.height_px);
             y < image.height_px + std::min(reach, image.height_px); ++y) {
            for (std::uint32_t x = image.width_px - std::min(reach, image.width_px);
                 x < image.width_px + std::min(reach, image.width_px); ++x) {
                const FieldPixel pixel{static_cast<std::uint16_t>(x),
                                       static_cast<std::uint16_t>(y)};
                if (radius_px(pixel) <= radius && in_picture_ < target_) {
                    take(pixel);
                }
            }
        }
    }

    /// A draw from one of the two Gaussians; none if it falls outside the field.
    std::optional<Place> draw() {
        const bool narrow = uniform() < parameters_.narrow_share;
        const double spread = narrow ? pattern_.profile.narrow_px : pattern_.profile.wide_px;
        const double radius = spread * std::sqrt(-2.0 * std::log(1.0 - uniform()));
        const double angle = 2.0 * std::numbers::pi * uniform();
        const double x = pattern_.image.width_px + radius * std::cos(angle);
        const double y = pattern_.image.height_px + radius * std::sin(angle);
        const ImageSize field = pattern_.field();
        if (x < 0.0 || y < 0.0 || x >= field.width_px || y >= field.height_px) {
            return std::nullopt;
        }
        return Place{x, y};
    }

    /// Independent draws until the picture has its samples.
    Expected<void> take_draws() {
        const std::uint64_t limit = 4096 * target_ + 50'000'000;
        std::uint64_t draws = 0;
        for (; in_picture_ < target_; ++draws) {
            if (draws == limit) {
                return std::unexpected(
                    Error{ErrorKind::Usage,
                          fmt::format("sparse.share = {}: {} draws did not fill it; widen "
                                      "sparse.wide_spread = {} or lower sparse.narrow_share = {}",
                                      parameters_.share, draws, parameters_.wide_spread,
                                      parameters_.narrow_share)});
            }
            if (const auto place = draw(); place && !taken_[index(place->pixel())]) {
                take(place->pixel());
            }
        }
        const double count = static_cast<double>(draws);
        pattern_.profile.narrow_draws = parameters_.narrow_share * count;
        pattern_.profile.wide_draws = (1.0 - parameters_.narrow_share) * count;
        return {};
    }

    /// Poisson discs: a candidate counts if no sample lies within `packing` of the mean spacing at
    /// its place. The packing is relaxed in rounds until the picture has its samples. So the count
    /// is exact, and the spacing as wide as possible.
    void take_spaced() {
        Spacing spacing(pattern_.field());
        constexpr double kFirstPacking = 0.9;
        constexpr double kRelax = 0.93;
        const std::uint64_t round = 6 * target_ + 64;
        for (double packing = kFirstPacking; in_picture_ < target_; packing *= kRelax) {
            for (std::uint64_t i = 0; i < round && in_picture_ < target_; ++i) {
                const auto place = draw();
                if (!place || taken_[index(place->pixel())]) {
                    continue;
                }
                const double share = pattern_.profile.share(radius_px(place->pixel()));
                if (!spacing.any_within(*place, packing / std::sqrt(share))) {
                    take(place->pixel());
                    spacing.add(*place);
                }
            }
        }
    }

    const SparseParameters& parameters_;
    SparsePattern pattern_;
    std::mt19937_64 random_;
    std::vector<bool> taken_;
    std::uint64_t target_ = 0;
    std::uint64_t in_picture_ = 0;
};

}  // namespace

double SparseProfile::share(double radius_px) const {
    if (radius_px <= disc_radius_px) {
        return 1.0;
    }
    const auto expected = [&](double draws, double spread_px) {
        const double x = radius_px / spread_px;
        return draws * std::exp(-0.5 * x * x) / (2.0 * std::numbers::pi * spread_px * spread_px);
    };
    return -std::expm1(-(expected(narrow_draws, narrow_px) + expected(wide_draws, wide_px)));
}

FieldPixel SparsePattern::window(const gaze::PixelPosition& fovea) const {
    const auto origin = [](double position_px, std::uint32_t size) {
        const double corner = std::clamp(std::round(position_px), 0.0, static_cast<double>(size));
        return static_cast<std::uint16_t>(size - static_cast<std::uint32_t>(corner));
    };
    return {origin(fovea.x_px, image.width_px), origin(fovea.y_px, image.height_px)};
}

std::uint64_t SparsePattern::samples_in(const gaze::PixelPosition& fovea) const {
    const FieldPixel origin = window(fovea);
    return static_cast<std::uint64_t>(std::ranges::count_if(samples, [&](const FieldPixel& pixel) {
        return pixel.x >= origin.x && pixel.x < origin.x + image.width_px && pixel.y >= origin.y &&
               pixel.y < origin.y + image.height_px;
    }));
}

Expected<SparsePattern> make_sparse_pattern(const SparseParameters& parameters, ImageSize image) {
    if (const auto checked = check(parameters, image); !checked) {
        return std::unexpected(checked.error());
    }
    return PatternMaker(parameters, image).make();
}

SampleGrid SparseDensity::at(const FieldPoint& at) const {
    const double radius_px = std::hypot(at.pixel.x_px - fovea_.x_px, at.pixel.y_px - fovea_.y_px);
    return SampleGrid::square(std::sqrt(profile_.share(radius_px))).in_degrees(at);
}

}  // namespace gazeloop::foveation
