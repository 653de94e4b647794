#include "runtime/numerics/envelope_json.h"

#include <nlohmann/json.hpp>

namespace gazeloop::numerics {
namespace {

nlohmann::ordered_json errors_json(const EnvelopeRow::Errors& errors) {
    return {{"forward_px", errors.forward_px},
            {"inverse_px", errors.inverse_px},
            {"seam_px", errors.seam_px},
            {"fall_px", errors.fall_px},
            {"not_finite", errors.not_finite}};
}

}  // namespace

std::string envelope_json(const Envelope& envelope) {
    auto rows = nlohmann::ordered_json::array();
    for (const EnvelopeRow& row : envelope.rows) {
        rows.push_back({{"map", row.map},
                        {"width_px", row.image.width_px},
                        {"height_px", row.image.height_px},
                        {"sigma", row.sigma},
                        {"lp_width", row.lp.width},
                        {"lp_height", row.lp.height},
                        {"fovea", row.fovea},
                        {"fovea_on_screen", row.on_screen},
                        {"float", errors_json(row.cpu)},
                        {"device", errors_json(row.device)},
                        {"forward_bound_px", row.forward_bound_px},
                        {"inverse_bound_px", row.inverse_bound_px},
                        {"conditioning_px", row.conditioning_px},
                        {"forward_texels", row.forward_texels},
                        {"beyond_bound", row.beyond_bound},
                        {"target_px", row.target_px},
                        {"device_target_px", row.device_target_px},
                        {"useless", row.useless},
                        {"met", row.met()}});
    }
    const EnvelopeCounts counts = envelope.counts();
    auto tables = nlohmann::ordered_json::array();
    for (const TableBuild& build : envelope.tables) {
        tables.push_back({{"map", build.map}, {"build_ms", build.milliseconds}});
    }
    const nlohmann::ordered_json json{{"device", envelope.device},
                                      {"driver", envelope.driver},
                                      {"met", envelope.met()},
                                      {"counts",
                                       {{"useful", counts.useful},
                                        {"met", counts.met},
                                        {"met_for_float32", counts.for_float32},
                                        {"useless", counts.useless}}},
                                      {"draws", envelope.draws},
                                      {"draws_not_finite", envelope.draws_not_finite},
                                      {"draws_outside", envelope.draws_outside},
                                      {"seconds", envelope.seconds},
                                      {"tables_2160x2160", tables},
                                      {"rows", rows}};
    return json.dump(2, ' ', false, decltype(json)::error_handler_t::replace) + "\n";
}

}  // namespace gazeloop::numerics
