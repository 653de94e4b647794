#include "runtime/foveation/plans/nearest_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace gazeloop::foveation {
namespace {

TEST(NearestSamples, OfASampleIsItself) {
    const SparsePattern pattern = make_sparse_pattern({}, {100, 80}).value();
    const NearestSamples nearest = find_nearest_samples(pattern, 1).value();
    for (std::uint32_t i = 0; i < pattern.samples.size(); ++i) {
        EXPECT_EQ(nearest.of(pattern.samples[i].x, pattern.samples[i].y)[0], i);
    }
}

TEST(NearestSamples, AreThoseOfBruteForce) {
    for (const SparsePlacement placement :
         {SparsePlacement::Gaussian, SparsePlacement::BlueNoise}) {
        const SparsePattern pattern =
            make_sparse_pattern({.share = 0.05, .placement = placement}, {60, 44}).value();
        for (const std::uint32_t k : {1U, 4U, 8U}) {
            const NearestSamples nearest = find_nearest_samples(pattern, k).value();
            ASSERT_EQ(nearest.map.size(), std::size_t{120} * 88 * k);
            for (std::uint32_t y = 0; y < 88; ++y) {
                for (std::uint32_t x = 0; x < 120; ++x) {
                    std::vector<int> all;  // squared distances are whole
                    for (const FieldPixel& sample : pattern.samples) {
                        const int dx = sample.x - static_cast<int>(x);
                        const int dy = sample.y - static_cast<int>(y);
                        all.push_back(dx * dx + dy * dy);
                    }
                    std::ranges::sort(all);
                    std::vector<std::uint32_t> seen;
                    for (std::uint32_t i = 0; i < k; ++i) {
                        const std::uint32_t index = nearest.of(x, y)[i];
                        ASSERT_LT(index, pattern.samples.size());
                        const int dx = pattern.samples[index].x - static_cast<int>(x);
                        const int dy = pattern.samples[index].y - static_cast<int>(y);
                        ASSERT_EQ(dx * dx + dy * dy, all[i]) << x << ' ' << y << ' ' << i;
                        ASSERT_EQ(std::ranges::count(seen, index), 0);
                        seen.push_back(index);
                    }
                }
            }
        }
    }
}

TEST(NearestSamples, RefuseMoreThanThereAre) {
    const SparsePattern pattern = make_sparse_pattern({}, {100, 80}).value();
    for (const std::uint32_t k : {0U, 9U, 4294967295U}) {
        const auto nearest = find_nearest_samples(pattern, k);
        ASSERT_FALSE(nearest.has_value()) << k;
        EXPECT_EQ(nearest.error().kind, ErrorKind::Usage);
        EXPECT_NE(nearest.error().message.find("must lie in [1, 8]"), std::string::npos)
            << nearest.error().message;
    }
    SparsePattern two = pattern;
    two.samples.resize(2);
    EXPECT_FALSE(find_nearest_samples(two, 4).has_value());
    EXPECT_TRUE(find_nearest_samples(two, 2).has_value());
    two.samples.clear();
    EXPECT_FALSE(find_nearest_samples(two, 1).has_value());
}

}  // namespace
}  // namespace gazeloop::foveation
