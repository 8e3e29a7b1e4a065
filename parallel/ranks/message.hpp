// Packs numbers and records into the bytes of a message, and reads them in the same order. All ranks run on the same
// kind of machine, so records are sent as they lie in memory.
#pragma once

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "parallel/ranks/ranks.hpp"

namespace carom {

template <class T>
void put(Bytes& message, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t end = message.size();
  message.resize(end + sizeof(T));
  std::memcpy(message.data() + end, &value, sizeof(T));
}

// The number of values comes first.
template <class T>
void put_all(Bytes& message, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  put(message, values.size());
  const std::size_t end = message.size();
  message.resize(end + values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(message.data() + end, values.data(), values.size() * sizeof(T));
}

inline void put_text(Bytes& message, const std::string& text) {
  put_all(message, std::vector<char>(text.begin(), text.end()));
}

// Reads a message made by put, put_all and put_text; throws std::out_of_range if it is too short. The message must
// outlive the reader.
class MessageReader {
 public:
  explicit MessageReader(const Bytes& message) : message_(message) {}

  bool at_end() const { return at_ == message_.size(); }

  template <class T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    std::memcpy(&value, take(1, sizeof(T)), sizeof(T));
    return value;
  }

  template <class T>
  std::vector<T> get_all() {
    const auto count = get<std::size_t>();
    const std::byte* const from = take(count, sizeof(T));
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), from, count * sizeof(T));
    return values;
  }

  std::string get_text() {
    const std::vector<char> text = get_all<char>();
    return {text.begin(), text.end()};
  }

  // Calls use(value) for each value of a put_all, without copying all of them.
  template <class T, class Use>
  void for_each(Use&& use) {
    const auto count = get<std::size_t>();
    const std::byte* from = take(count, sizeof(T));
    for (std::size_t k = 0; k < count; ++k, from += sizeof(T)) {
      T value{};
      std::memcpy(&value, from, sizeof(T));
      use(value);
    }
  }

 private:
  const std::byte* take(std::size_t count, std::size_t size) {
    if (count > (message_.size() - at_) / size) throw std::out_of_range("a message between ranks is too short");
    const std::byte* const from = message_.data() + at_;
    at_ += count * size;
    return from;
  }

  const Bytes& message_;
  std::size_t at_ = 0;
};

}  // namespace carom
