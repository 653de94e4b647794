#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gazeloop::bench {

/// A session of an hour of simulated gaze at 1 kHz and 90 Hz, in virtual time, that all of these
/// gazeloop programs read: the one in the cache (1.1 GB), or a new one by the last of them. Throws
/// std::runtime_error where it cannot be made.
std::filesystem::path session_of_an_hour(const std::vector<std::string>& programs);

/// Four times that hour, one after the other, with numbers and times that go on; kept in the cache.
std::filesystem::path session_of_four_hours(const std::filesystem::path& hour);

}  // namespace gazeloop::bench
