#include "tests/support/coded/coded_recordings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include "tests/support/recorded_data.h"

namespace gazeloop::tests {
namespace {

struct Screen {
    double width_m, height_m, width_px, height_px, distance_m;

    [[nodiscard]] glm::dvec3 direction(double x_px, double y_px) const {
        return glm::normalize(glm::dvec3{(x_px / width_px - 0.5) * width_m,
                                         (0.5 - y_px / height_px) * height_m, -distance_m});
    }
};

Screen screen_of(const std::filesystem::path& csv) {
    std::ifstream in(std::filesystem::path(csv).replace_extension(".json"));
    const nlohmann::json json = nlohmann::json::parse(in);
    return {json.at("screen_size_m").at(0), json.at("screen_size_m").at(1),
            json.at("screen_px").at(0), json.at("screen_px").at(1), json.at("view_distance_m")};
}

CodedRecording read(const std::filesystem::path& csv, const std::string& stimulus) {
    const Screen screen = screen_of(csv);
    CodedRecording recording;
    recording.stimulus = stimulus;
    const std::string stem = csv.stem().string();
    recording.person = stem.substr(0, stem.find('_'));
    std::ifstream in(csv);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        double time_ms = 0.0;
        double x_px = 0.0;
        double y_px = 0.0;
        CodedSample sample;
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%d,%d", &time_ms, &x_px, &y_px,
                        &sample.first_coder, &sample.second_coder) != 5) {
            throw std::runtime_error(csv.string() + " has a line of another form: " + line);
        }
        sample.time_ns = std::llround(time_ms * 1e6);
        if (x_px != 0.0 || y_px != 0.0) {
            sample.direction = screen.direction(x_px, y_px);
        }
        recording.samples.push_back(sample);
    }
    return recording;
}

}  // namespace

std::filesystem::path coded_recordings_folder() { return recorded_data("traces/andersson2017"); }

std::vector<CodedRecording> read_coded_recordings(const std::filesystem::path& folder) {
    std::vector<CodedRecording> recordings;
    std::set<std::string> persons;
    for (const char* const stimulus : kStimuli) {
        std::set<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder / stimulus)) {
            if (entry.path().extension() == ".csv") {
                files.insert(entry.path());
            }
        }
        for (const std::filesystem::path& file : files) {
            recordings.push_back(read(file, stimulus));
            persons.insert(recordings.back().person);
        }
    }
    for (CodedRecording& recording : recordings) {
        recording.chosen_on =
            std::distance(persons.begin(), persons.find(recording.person)) % 2 == 0;
    }
    return recordings;
}

CodedRecording thinned(const CodedRecording& recording, std::size_t every) {
    CodedRecording thin = recording;
    thin.samples.clear();
    for (std::size_t i = 0; i < recording.samples.size(); i += every) {
        thin.samples.push_back(recording.samples[i]);
    }
    return thin;
}

}  // namespace gazeloop::tests
