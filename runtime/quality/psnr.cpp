#include "runtime/quality/psnr.h"

#include <cmath>
#include <numeric>

#include "runtime/quality/encoded_colour.h"

namespace gazeloop::quality {

double psnr_db(const render::LinearPicture& reference, const render::LinearPicture& test,
               const Plane& weights, const RowWork& work) {
    const auto of_reference = encoded_channels(reference, work);
    const auto of_test = encoded_channels(test, work);
    std::vector<double> row_sums(reference.height);
    work.over(reference.height, [&](std::uint32_t from, std::uint32_t to) {
        for (std::uint32_t y = from; y < to; ++y) {
            const float* const weight = weights.row(y);
            for (std::size_t c = 0; c < of_test.size(); ++c) {
                const float* const a = of_reference[c].row(y);
                const float* const b = of_test[c].row(y);
                for (std::uint32_t x = 0; x < reference.width; ++x) {
                    const double difference = static_cast<double>(a[x]) - static_cast<double>(b[x]);
                    row_sums[y] += static_cast<double>(weight[x]) * difference * difference;
                }
            }
        }
    });
    return -10.0 * std::log10(std::accumulate(row_sums.begin(), row_sums.end(), 0.0) / 3.0);
}

}  // namespace gazeloop::quality
