#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/ground/cached_products.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/view.h"

namespace belvedere {

// An input of a value: the name of another value, and a text that is equal only if the parts read
// of it are equal.
struct ValueInput {
  std::string name;  // of a value of the store, or of what it stands for in drawings
  std::string key;
};

// Keeps the values of a scene, one of each name, for programs that make many pictures of one scene:
// the next one takes a value over if its inputs have not changed. Results never depend on it.
// Whatever was made before must be destroyed before the next is made, because values may be changed
// in place. Not thread-safe.
class ValueStore {
 public:
  struct Kept {
    std::string key;
    std::shared_ptr<void> value;
    std::vector<std::string> notes;  // told again whenever it is taken over
    std::vector<ValueInput> inputs;
  };
  // The kept value of that name and key; null where there is none.
  const Kept* find(const std::string& name, const std::string& key) const;
  // The key of a value; empty where there is none of that name.
  std::string key(const std::string& name) const;
  void keep(const std::string& name, Kept made) { kept_[name] = std::move(made); }
  // Drops a value and all that were made from it, before memory is taken for the next.
  void forget(const std::string& name);
  // The values and what they are made from as a Mermaid diagram.
  std::string draw() const;

 private:
  std::map<std::string, Kept> kept_;
};

// A value as it was made or found.
template <class T>
struct Value : ValueInput {
  std::shared_ptr<T> value;
  T& operator*() const { return *value; }
  T* operator->() const { return value.get(); }
};

// Arguments of a function that makes a value, besides its inputs.
struct Making {
  const LoadedScene& scene;  // the declared parts; all else has its default and names no file
  Progress& progress;
};

// Makes values of a scene in the order of the program. Each is declared by the parts of the scene
// that it reads and by its inputs: its key follows from them (settings, and the files that they
// name, by size and time), and its maker sees no other part, so that a value cannot be stale.
class SceneValues {
 public:
  // `store`: null to keep nothing.
  SceneValues(const LoadedScene& loaded, ValueStore* store, Progress& progress)
      : loaded_(loaded), store_(store), progress_(progress) {}
  SceneValues(LoadedScene&& temporary, ValueStore* store, Progress& progress) = delete;

  bool keeps() const { return store_ != nullptr; }
  // Copies the parts that a value reads into a scene of defaults.
  using Reads = std::function<void(Scene& to, const Scene& from)>;
  template <class T, class Make>
  Value<T> make(const std::string& name, const Reads& reads, std::vector<ValueInput> inputs,
                const Make& make) const {
    return make_with<T>(name, reads, std::move(inputs), progress_, make);
  }
  // Makes a value inside another one, whose `progress` reports it.
  template <class T, class Make>
  Value<T> make_with(const std::string& name, const Reads& reads, std::vector<ValueInput> inputs,
                     Progress& progress, const Make& make) const {
    LoadedScene part = part_of(reads);
    if (store_ == nullptr)
      return {{name, {}}, std::shared_ptr<T>(new T(make(Making{part, progress})))};
    std::string key = key_of(part, inputs);
    part.scene.title = loaded_.scene.title;  // names products in lists of the cache
    if (const ValueStore::Kept* kept = store_->find(name, key)) {
      for (const std::string& note : kept->notes) progress.note(note);
      return {{name, key}, std::static_pointer_cast<T>(kept->value)};
    }
    store_->forget(name);
    KeptNotes watcher(progress);
    const std::shared_ptr<T> made(new T(make(Making{part, watcher})));
    store_->keep(name, {key, std::const_pointer_cast<std::remove_const_t<T>>(made), watcher.notes(),
                        std::move(inputs)});
    return {{name, key}, made};
  }

 private:
  LoadedScene part_of(const Reads& reads) const;
  static std::string key_of(const LoadedScene& part, std::span<const ValueInput> inputs);

  const LoadedScene& loaded_;
  ValueStore* store_;
  Progress& progress_;
};
// The Reads of values that do not depend on the scene.
void reads_nothing(Scene& to, const Scene& from);

// Parts of a view as inputs.
ValueInput content_of(const CameraParameters& camera);
ValueInput content_of(const DeformParameters& deform, glm::dvec2 viewer_xy);
ValueInput content_of(const GeneralizeDistances& distances, glm::dvec2 viewer_xy);

}  // namespace belvedere
