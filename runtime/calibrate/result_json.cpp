#include "runtime/calibrate/result_json.h"

#include <nlohmann/json.hpp>

namespace gazeloop::calibrate {

nlohmann::ordered_json result_json(const calibration::CalibrationResult& result,
                                   const std::string& file) {
    nlohmann::ordered_json json{
        {"file", file.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(file)}};
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t i = gaze::index(eye);
        nlohmann::ordered_json of_eye{{"points", result.points[i].size()}};
        if (const auto& fit = result.eyes[i]) {
            nlohmann::ordered_json left_out = nlohmann::ordered_json::array();
            for (const std::size_t point : fit->left_out) {
                left_out.push_back(result.points[i][point] + 1);
            }
            of_eye["before_median_deg"] = fit->before_median_deg;
            of_eye["leave_one_out_median_deg"] = fit->leave_one_out_median_deg;
            of_eye["leave_one_out_greatest_deg"] = fit->leave_one_out_greatest_deg;
            of_eye["points_left_out"] = left_out;
        } else {
            of_eye["problem"] = result.problems[i];
        }
        json[std::string(gaze::kEyeNames[i])] = of_eye;
    }
    return json;
}

}  // namespace gazeloop::calibrate
