// Where what is costly to compute is kept between programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace scattermeter {

// May be shared by several programs and used from several threads at once. Errors of the storage
// are its own: what cannot be read is not there, and what cannot be written is not kept.
template <class Kept>
class KeptStore {
 public:
  virtual ~KeptStore() = default;
  // Equal numbers, equal names.
  virtual std::string name(const std::vector<double>& numbers) const = 0;
  virtual std::optional<Kept> find(const std::string& name) = 0;
  virtual void keep(const std::string& name, const Kept& kept) = 0;
};

// From the store if it is there; else made and kept. numbers: all that it follows from.
template <class Kept, class Make>
Kept found_or_made(KeptStore<Kept>& store, const std::vector<double>& numbers, const Make& make) {
  const std::string name = store.name(numbers);
  if (std::optional<Kept> found = store.find(name)) return *std::move(found);
  Kept out = make();
  store.keep(name, out);
  return out;
}

}  // namespace scattermeter
