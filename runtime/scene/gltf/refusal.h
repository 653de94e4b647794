#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gazeloop::scene::gltf {

/// Why a file cannot be used: the place (a JSON pointer, or empty: the file as a whole), and what
/// is wrong with the remedy. Thrown inside this room alone: load() makes an Error of it.
class Refusal : public std::runtime_error {
  public:
    Refusal(std::string place, const std::string& what)
        : std::runtime_error(what), place_(std::move(place)) {}
    [[nodiscard]] const std::string& place() const { return place_; }

  private:
    std::string place_;
};

[[noreturn]] inline void refuse(std::string place, const std::string& what) {
    throw Refusal(std::move(place), what);
}

/// What a file has that is not as the standard says, or that is not shown, and does not keep it
/// from being used.
struct Note {
    std::string kind;         ///< what is counted together
    std::string place;        ///< JSON pointer of the first
    std::string text;         ///< of the first
    std::uint64_t times = 1;  ///< how many of this kind
};

/// Gathers notes, one per kind, in the order of their first.
class Notes {
  public:
    void add(std::string_view kind, std::string_view place, std::string text) {
        add({.kind = std::string(kind), .place = std::string(place), .text = std::move(text)});
    }
    void add(Note note) {
        const auto [at, is_new] = index_.try_emplace(note.kind, notes_.size());
        if (is_new) {
            notes_.push_back(std::move(note));
        } else {
            notes_[at->second].times += note.times;
        }
    }
    [[nodiscard]] const std::vector<Note>& all() const { return notes_; }

  private:
    std::vector<Note> notes_;
    std::map<std::string, std::size_t, std::less<>> index_;
};

}  // namespace gazeloop::scene::gltf
