// Counts with 16 bits: a disk with more contacts than they can count must not appear as one with a single contact.
#include "parallel/stepping/contact_count.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "parallel/stepping/resolve_contacts.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {
namespace {

constexpr std::size_t one_too_many = 65537;

TEST(ContactCount, StaysLarge) {
  std::uint16_t count = 0;
  for (std::size_t k = 1; k <= 3 * one_too_many; ++k) {
    count_contact(count);
    ASSERT_EQ(count, std::min<std::size_t>(k, many_contacts));
  }
}

TEST(ContactCount, StaysLargeOnManyThreads) {
  constexpr std::uint16_t threads = 4;
  std::uint16_t count = 0;
  Executor(threads).run(100, [&](std::size_t) {
    for (std::size_t k = 0; k < one_too_many; ++k) count_contact_shared(count);
  });
  EXPECT_EQ(count, many_contacts);
  count = 0;
  Executor(threads).run(100, [&](std::size_t) {
    for (int k = 0; k < 7; ++k) count_contact_shared(count);
  });
  EXPECT_EQ(count, 700U);
}

// The counts of the engine for a disk with 65,537 contacts, each of them the only one of the other disk.
TEST(ContactCount, OfTheEngineTakesNoCrowdedContactForAlone) {
  ContactLists lists;
  lists.contacts.resize(one_too_many + 1, 0);
  for (std::uint32_t k = 1; k <= one_too_many; ++k) lists.events.push_back({0.0, 0, k, 0, k});
  count_contacts(lists, Executor(3));
  for (const ContactEvent& e : lists.events) ASSERT_FALSE(is_alone(lists, e));
  lists.events.resize(1);
  lists.contacts.assign(one_too_many + 1, 0);
  count_contacts(lists, Executor(3));
  EXPECT_TRUE(is_alone(lists, lists.events[0]));
}

}  // namespace
}  // namespace carom
