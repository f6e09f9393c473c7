#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/state_archive.h"
#include "reference/piles/pile_contact.h"
#include "reference/piles/pile_slabs.h"

namespace slipcheck {

/// Which places in a row are taken.
class PilePlaces {
 public:
  std::uint32_t take() {
    if (free_.empty()) return size_++;
    const std::uint32_t place = free_.back();
    free_.pop_back();
    return place;
  }
  void leave(std::uint32_t place) { free_.push_back(place); }
  void exchange(StateArchive& archive) { archive(free_, size_); }

 private:
  std::vector<std::uint32_t> free_;
  std::uint32_t size_ = 0;  ///< with these
};

/// The contacts of a slab one by one, by PileNear::contact.
template <bool kTurns>
class PileContacts {
 public:
  using Contact = PileContact<kTurns>;

  bool touches(std::size_t k) const { return contacts_[k].touching; }
  double impulse(std::size_t k) const { return contacts_[k].impulse; }
  const Contact& get(std::size_t k, const PileLaw&) const { return contacts_[k]; }
  template <class What>
  void change(const PileNear& near, const PileLawTable&, const What& what) {
    what(contacts_[near.contact]);
  }
  /// As the contact of `near`, which has none.
  void keep(PileNear& near, const Contact& contact, const PileLawTable& laws) {
    near.contact = places_.take();
    if (near.contact == contacts_.size())
      contacts_.push_back(contact);
    else
      contacts_[near.contact] = contact;
    contacts_[near.contact].first = near.first;
    contacts_[near.contact].second = near.second;
    set_law(near, laws);
  }
  void drop(PileNear& near) {
    places_.leave(near.contact);
    near.contact = PileNear::kNone;
  }
  void set_law(const PileNear& near, const PileLawTable& laws) {
    contacts_[near.contact].law = &laws[near.law];
  }
  void exchange(StateArchive& archive) {
    archive(contacts_, places_);
    if (archive.reads())
      for (Contact& c : contacts_) c.law = nullptr;  // of no process but the one that wrote
  }

 private:
  std::vector<Contact> contacts_;
  PilePlaces places_;
};

}  // namespace slipcheck
