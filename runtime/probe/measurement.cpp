#include "runtime/probe/measurement.h"

#include <fmt/core.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "runtime/open_for_reading.h"

namespace gazeloop::probe {
namespace {

using Json = nlohmann::json;

/// Reads fields of one file; throws what is wrong as an Error's text.
class Fields {
  public:
    explicit Fields(const Json& json) : json_(&json) {}

    [[nodiscard]] const Json& at(const std::string& path) const {
        const Json::json_pointer pointer(path);
        if (!json_->contains(pointer)) {
            throw std::invalid_argument(fmt::format("it lacks '{}'", path));
        }
        return json_->at(pointer);
    }
    [[nodiscard]] double number(const std::string& path) const {
        const Json& value = at(path);
        constexpr double kMost = 1e9;
        if (!value.is_number() || !(std::abs(value.get<double>()) <= kMost)) {
            throw std::invalid_argument(fmt::format("'{}' is no number of milliseconds", path));
        }
        return value.get<double>();
    }

  private:
    const Json* json_;
};

std::optional<MeasuredDelay> delay(const Fields& fields, const std::string& of) {
    const Json& trials = fields.at(of + "/trials");
    if (!trials.is_number_unsigned()) {
        throw std::invalid_argument(fmt::format("'{}/trials' is no count", of));
    }
    if (trials.get<std::uint64_t>() == 0) {
        return std::nullopt;
    }
    MeasuredDelay result{.trials = trials.get<std::uint64_t>(),
                         .mean_ms = fields.number(of + "/mean_ms"),
                         .uncertain_ms = std::nullopt,
                         .min_ms = fields.number(of + "/min_ms"),
                         .max_ms = fields.number(of + "/max_ms")};
    const std::string uncertain = of + "/uncertain_ms";
    if (!fields.at(uncertain).is_null()) {
        result.uncertain_ms = fields.number(uncertain);
        if (*result.uncertain_ms < 0.0) {
            throw std::invalid_argument(fmt::format("'{}' is negative", uncertain));
        }
    }
    constexpr double kRounding = 1e-6;
    if (result.min_ms > result.mean_ms + kRounding || result.mean_ms > result.max_ms + kRounding) {
        throw std::invalid_argument(fmt::format("'{}/mean_ms' lies outside its trials", of));
    }
    return result;
}

std::vector<std::string> warnings(const Json& json) {
    std::vector<std::string> texts;
    for (const Json& one : json.value("warnings", Json::array())) {
        if (!one.is_string()) {
            throw std::invalid_argument("'/warnings' are no texts");
        }
        texts.push_back(one.get<std::string>());
    }
    return texts;
}

}  // namespace

Expected<Measurement> parse_measurement(std::string_view text, const std::string& source) {
    const auto refuse = [&](std::string_view why) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}: is no result of gazeloop probe --video --json ({})", source, why)});
    };
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) {
        return refuse("it is not a JSON object");
    }
    try {
        const Fields fields(json);
        if (fields.at("/format") != Json(kMeasurementFormat)) {
            return refuse("its 'format' is another");
        }
        if (fields.at("/version") != Json(kMeasurementVersion)) {
            return refuse(
                fmt::format("its 'version' is not {}, of another gazeloop", kMeasurementVersion));
        }
        const Json& pulsed = fields.at("/patch/pulsed");
        if (!pulsed.is_boolean()) {
            return refuse("'/patch/pulsed' is neither true nor false");
        }
        return Measurement{.source = source,
                           .eye_lost = delay(fields, "/eye_lost"),
                           .eye_found = delay(fields, "/eye_found"),
                           .pulsed = pulsed.get<bool>(),
                           .warnings = warnings(json)};
    } catch (const std::invalid_argument& error) {
        return refuse(error.what());
    }
}

Expected<Measurement> read_measurement(const std::filesystem::path& file) {
    auto in = open_regular_file(file);
    if (!in) {
        return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: cannot be read ({})",
                                                                      file.string(), in.error())});
    }
    const std::string text{std::istreambuf_iterator<char>(*in), {}};
    return parse_measurement(text, file.string());
}

}  // namespace gazeloop::probe
