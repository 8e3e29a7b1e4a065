// The canonical order of events: the one sequence in which a method, serial or parallel, takes what happens.
#pragma once

namespace carom {

// Order by the smaller id, then by the larger. For any records with id1 <= id2; id2 may be a wall_partner.
struct IdsOrder {
  template <class A, class B>
  constexpr bool operator()(const A& a, const B& b) const {
    return a.id1 != b.id1 ? a.id1 < b.id1 : a.id2 < b.id2;
  }
};
inline constexpr IdsOrder ids_order;

// When an event happens. Records whose time is not in `time` have a time_of of their own.
template <class Event>
constexpr double time_of(const Event& e) {
  return e.time;
}

// a before b: the earlier one, ties in ids_order. A total order, so that events are taken in the same sequence whatever
// search found them, in whatever order, on however many threads.
struct EventOrder {
  template <class Event>
  constexpr bool operator()(const Event& a, const Event& b) const {
    return time_of(a) != time_of(b) ? time_of(a) < time_of(b) : ids_order(a, b);
  }
};
inline constexpr EventOrder event_order;

// The reverse, for heaps that have the first event on top.
struct LaterEvent {
  template <class Event>
  constexpr bool operator()(const Event& a, const Event& b) const {
    return event_order(b, a);
  }
};

}  // namespace carom
