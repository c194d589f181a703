#include "bench/peer_module.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <graze/io/error.hpp>

namespace graze::bench {

PeerModule::PeerModule() {
  const std::filesystem::path file =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / GRAZE_BENCH_MODULE;
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr)
    throw io::InputError(std::string(dlerror()) +
                         "; graze_studies bench runs from the folder it is built in, beside that file");
  const auto list = reinterpret_cast<ListPeers>(dlsym(module, "graze_bench_peers"));
  const auto list_rigid =
      reinterpret_cast<ListRigidContactFinders>(dlsym(module, "graze_bench_rigid_contacts"));
  if (list == nullptr || list_rigid == nullptr)
    throw io::InputError(file.string() + ": is not what graze_studies bench was built with");
  list(entries_, compiled_for_);
  list_rigid(rigid_contact_finders_);
  make_soft_contact_finder_ =
      reinterpret_cast<MakeSoftContactFinder>(dlsym(module, "graze_bench_soft_contacts"));
  make_ray_caster_ = reinterpret_cast<MakeRayCaster>(dlsym(module, "graze_bench_rays"));
  make_self_contact_finder_ =
      reinterpret_cast<MakeSelfContactFinder>(dlsym(module, "graze_bench_self_contacts"));
}

std::unique_ptr<SoftContactFinder> PeerModule::soft_contact_finder(
    std::span<const SoftBodyView> bodies, const SoftContactSettings& settings) const {
  std::unique_ptr<SoftContactFinder> finder;
  if (make_soft_contact_finder_ != nullptr) make_soft_contact_finder_(bodies, settings, finder);
  return finder;
}

std::unique_ptr<RayCaster> PeerModule::ray_caster(const World& world, RayTree tree, unsigned threads) const {
  std::unique_ptr<RayCaster> caster;
  if (make_ray_caster_ != nullptr) make_ray_caster_(world, tree, threads, caster);
  return caster;
}

std::unique_ptr<SelfContactFinder> PeerModule::self_contact_finder(const SelfSurface& surface,
                                                                   double distance) const {
  std::unique_ptr<SelfContactFinder> finder;
  if (make_self_contact_finder_ != nullptr) make_self_contact_finder_(surface, distance, finder);
  return finder;
}

const PeerEntry& PeerModule::entry(std::string_view name) const {
  for (const PeerEntry& entry : entries_)
    if (entry.name == name) return entry;
  std::string known;
  for (const PeerEntry& entry : entries_) known += (known.empty() ? "" : ", ") + std::string(entry.name);
  throw io::InputError("no peer \"" + std::string(name) + "\"; there are " + known);
}

}  // namespace graze::bench
