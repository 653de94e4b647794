#include "drivers/calibrated/calibrated_source.h"

#include "runtime/gaze/direction.h"

namespace gazeloop::drivers {

void CalibratedSource::poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    const std::size_t before = samples.size();
    source_->poll(now_ns, samples);
    for (std::size_t i = before; i < samples.size(); ++i) {
        for (const gaze::Eye eye : gaze::kEyes) {
            gaze::EyeRay& ray = samples[i].eyes[gaze::index(eye)];
            const auto& of_eye = calibration_[gaze::index(eye)];
            const auto direction = gaze::unit(ray.direction);
            if (of_eye && ray.valid && direction) {
                ray.direction = calibration::corrected(*of_eye, *direction);
            }
        }
    }
}

}  // namespace gazeloop::drivers
