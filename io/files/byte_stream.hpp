// Writes plain values as bytes and reads them, for checkpoints: numbers as they lie in memory, lists preceded by their
// lengths. A struct is written and read by one function, fields(stream, value), so that the two cannot differ.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace carom {

template <class T>
concept Number = (std::is_arithmetic_v<T> && !std::same_as<T, bool>) || std::is_enum_v<T>;

// T is U or const U; for the declaration of a fields() that both writes and reads.
template <class T, class U>
concept Is = std::same_as<std::remove_const_t<T>, U>;

// Passes the bytes to `sink`, in any pieces. writes(list), if given, may pass a list, preceded by its length, to the
// sink itself and return true; if it returns false the writer does so.
class ByteWriter {
 public:
  using Sink = std::function<void(const char*, std::size_t)>;
  using ListWriter = std::function<bool(const void*)>;
  explicit ByteWriter(Sink sink, ListWriter writes = {}) : sink_(std::move(sink)), writes_(std::move(writes)) {}

  template <class... Parts>
  void operator()(const Parts&... parts) {
    (put(parts), ...);
  }

 private:
  void raw(const void* data, std::size_t bytes) { sink_(static_cast<const char*>(data), bytes); }
  template <Number T>
  void put(const T& value) {
    raw(&value, sizeof value);
  }
  void put(const bool& value) { put(static_cast<unsigned char>(value ? 1 : 0)); }
  void put(const std::string& text) {
    put(std::uint64_t{text.size()});
    raw(text.data(), text.size());
  }
  template <Number T, std::size_t N>
  void put(const T (&values)[N]) {
    raw(values, sizeof values);
  }
  template <Number T, std::size_t N>
  void put(const std::array<T, N>& values) {
    raw(values.data(), sizeof values);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    if (writes_ && writes_(&list)) return;
    put(std::uint64_t{list.size()});
    if constexpr (Number<T>) {
      raw(list.data(), list.size() * sizeof(T));
    } else {
      for (const T& entry : list) put(entry);
    }
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class T>
  requires std::is_class_v<T>
  void put(const T& value) { fields(*this, value); }

  Sink sink_;
  ListWriter writes_;
};

// Thrown if the bytes do not have the expected content.
struct BadBytes : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Reads bytes from `source`, `left` of them in all. Throws BadBytes instead of reading beyond them, or making a list
// longer than the bytes left. passes(list, bytes), if given, may skip the bytes of a list of numbers in the source
// itself, so that the list stays empty, and return true; if it returns false the reader reads the list.
class ByteReader {
 public:
  using Source = std::function<void(char*, std::size_t)>;
  using ListPass = std::function<bool(const void*, std::uint64_t)>;
  ByteReader(Source source, std::uint64_t left, ListPass passes = {})
      : source_(std::move(source)), left_(left), passes_(std::move(passes)) {}

  template <class... Parts>
  void operator()(Parts&... parts) {
    (get(parts), ...);
  }

  std::uint64_t left() const { return left_; }

 private:
  void raw(void* data, std::uint64_t bytes) {
    if (bytes > left_) throw BadBytes("ends early");
    left_ -= bytes;
    source_(static_cast<char*>(data), bytes);
  }
  // Every entry takes at least one byte.
  std::size_t length(std::size_t bytes_each) {
    std::uint64_t entries = 0;
    get(entries);
    if (entries > left_ / bytes_each) throw BadBytes("has a list longer than itself");
    return static_cast<std::size_t>(entries);
  }
  template <Number T>
  void get(T& value) {
    raw(&value, sizeof value);
  }
  void get(bool& value) {
    unsigned char byte = 0;
    get(byte);
    if (byte > 1) throw BadBytes("has a flag that is neither 0 nor 1");
    value = byte == 1;
  }
  void get(std::string& text) {
    text.resize(length(1));
    raw(text.data(), text.size());
  }
  template <Number T, std::size_t N>
  void get(T (&values)[N]) {
    raw(values, sizeof values);
  }
  template <Number T, std::size_t N>
  void get(std::array<T, N>& values) {
    raw(values.data(), sizeof values);
  }
  template <class T>
  void get(std::vector<T>& list) {
    if constexpr (Number<T>) {
      const std::size_t entries = length(sizeof(T));
      if (passes_ && passes_(&list, entries * sizeof(T))) {
        left_ -= entries * sizeof(T);
        return;
      }
      list.resize(entries);
      raw(list.data(), list.size() * sizeof(T));
    } else {
      // Entries may be larger in memory than in the file, so the list grows with the data read, not with the stored
      // length.
      const std::size_t entries = length(1);
      list.clear();
      for (std::size_t k = 0; k < entries; ++k) get(list.emplace_back());
    }
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool there = false;
    get(there);
    value.reset();
    if (there) get(value.emplace());
  }
  template <class T>
  requires std::is_class_v<T>
  void get(T& value) { fields(*this, value); }

  Source source_;
  std::uint64_t left_;
  ListPass passes_;
};

}  // namespace carom
