#include "scene/contact_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <set>

#include "scenario/contact_models.h"
#include "scenario/surfaces.h"
#include "scene/contact_maker.h"
#include "scene/contact_warnings.h"
#include "scene/obstacles.h"
#include "scene/own_contacts.h"
#include "scene/scene_outline.h"

namespace slipcheck {
namespace {

/// A restitution `viscoelastic` takes a dissipation time of both materials.
void look_at(const Scenario& scenario, const ContactMaker& maker, Obstacles& obstacles) {
  if (!maker.is_viscoelastic_restitution()) return;
  const BodyContact& contact = maker.contact();
  for (const std::string& name : std::set{contact.first, contact.second}) {
    const auto material = scenario.materials.find(name);
    if (material == scenario.materials.end() || material->second.dissipation_time) continue;
    obstacles.add(contact.path + ".normal.restitution",
                  "can only be solved with materials." + name + ".dissipation_time",
                  "viscoelastic");
  }
}

struct MadeContact {
  PairContact hard;
  std::optional<SoftContact> soft;
};

MadeContact make_contact(const ContactMaker& maker, const ClassPair& pair) {
  if (!maker.is_soft()) return {maker.hard(pair), std::nullopt};
  const SoftContact soft = maker.soft(pair);
  return {maker.hard_equivalent(soft, pair), soft};
}

/// One maker for each contact of the file.
class Makers {
 public:
  explicit Makers(const Scenario& scenario) : scenario_(scenario) {
    for (const BodyContact& contact : scenario.contacts) makers_.emplace_back(scenario, contact);
  }

  const std::list<ContactMaker>& all() const { return makers_; }
  /// Of two materials, or one and a surface of the box; null where the file has none.
  const ContactMaker* find(const std::string& first, const std::string& second) const {
    const BodyContact* contact = find_contact(scenario_, first, second);
    if (!contact) return nullptr;
    return &*std::ranges::find(makers_, contact,
                               [](const ContactMaker& each) { return &each.contact(); });
  }

 private:
  const Scenario& scenario_;
  std::list<ContactMaker> makers_;
};

/// Of each two rows that of their first bodies, with a look at all that stand for them.
void make_pairs(const Scenario& scenario, const Makers& makers, SceneOutline& outline,
                std::vector<std::optional<SoftContact>>& soft) {
  const std::size_t size = outline.rows.size();
  soft.resize(size * size);
  for (std::size_t a = 0; a < size; ++a)
    for (std::size_t b = a; b < size; ++b) {
      const std::vector<BodyClass>&first = outline.rows[a], &second = outline.rows[b];
      const ContactMaker* maker = makers.find(first[0].material, second[0].material);
      if (!maker) continue;
      for (std::size_t k = first.size(); k-- > 0;)
        for (std::size_t n = second.size(); n-- > 0;) {
          const MadeContact contact =
              make_contact(*maker, class_pair(scenario, first[k], second[n]));
          for (const std::size_t at : {a * size + b, b * size + a}) {
            outline.scene.pairs[at] = contact.hard;
            soft[at] = contact.soft;
          }
        }
    }
}

/// Of one surface of the box with each class.
void make_surface(const Scenario& scenario, const std::vector<BodyClass>& classes,
                  const std::string& surface, const Makers& makers, std::vector<PairContact>& hard,
                  std::vector<std::optional<SoftContact>>& soft) {
  soft.resize(classes.size());
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const ContactMaker* maker = makers.find(classes[i].material, surface);
    if (!maker) continue;
    MadeContact made = make_contact(*maker, surface_pair(scenario, classes[i]));
    hard[i] = std::move(made.hard);
    soft[i] = std::move(made.soft);
  }
}

/// Of every class with every surface beside the substrate.
void make_surfaces(const Scenario& scenario, const SceneOutline& outline, const Makers& makers,
                   Scene& scene, std::vector<std::optional<SoftContact>>& soft) {
  for (const BodyClass& body : outline.classes)
    for (const NamedSurface& surface : scenario.surfaces) {
      SurfaceContact& contact = scene.on_surfaces.emplace_back();
      std::optional<SoftContact>& lasting = soft.emplace_back();
      const auto on =
          std::ranges::find_if(scenario.surface_contacts, [&](const MaterialOnSurface& each) {
            return each.material == body.material && each.surface == surface.material;
          });
      const auto material = scenario.materials.find(body.material);
      if (on != scenario.surface_contacts.end()) {
        contact = surface_contact(
            *on, material == scenario.materials.end() ? Material{} : material->second, body.sphere,
            scene.gravity);
      } else if (const ContactMaker* maker = makers.find(body.material, surface.material)) {
        MadeContact made = make_contact(*maker, surface_pair(scenario, body));
        contact = surface_contact(made.hard);
        lasting = std::move(made.soft);
      }
    }
}

/// A body beside other half-spaces never comes to what lies in one of them.
void warn_of_hidden(const Scenario& scenario, bool has_substrate,
                    std::vector<std::string>& warnings) {
  for (const NamedSurface& surface : scenario.surfaces) {
    const auto hides = [&](const PlaneShape& plane) {
      return highest_over(plane, surface.shape) <= 0;
    };
    const bool moves = !std::holds_alternative<StillMotion>(surface.motion) &&
                       !std::holds_alternative<BeltMotion>(surface.motion);
    const bool below = has_substrate && hides(PlaneShape{});
    const bool behind = std::ranges::any_of(scenario.surfaces, [&](const NamedSurface& other) {
      const auto* plane = std::get_if<PlaneShape>(&other.shape);
      return plane && &other != &surface && hides(*plane);
    });
    if (!moves && (below || behind))
      warnings.push_back(fmt::format("{}: no body can reach the surface {}, which lies behind {}",
                                     surface.path, surface.name,
                                     below ? "the substrate" : "another plane"));
  }
}

}  // namespace

std::optional<SoftContact> ContactScene::contact_of(std::size_t i, std::size_t j) const {
  if (!own) return between(i, j);
  return own->of(hard.row_of(i), hard.bodies[i], hard.row_of(j), hard.bodies[j]);
}

ContactScene make_contact_scene(const Scenario& scenario, std::size_t most_in_table) {
  const Makers makers(scenario);
  Obstacles obstacles(scenario);
  for (const ContactMaker& maker : makers.all()) look_at(scenario, maker, obstacles);
  obstacles.throw_any();

  SceneOutline outline = make_outline(scenario, most_in_table);
  ContactScene made;
  make_pairs(scenario, makers, outline, made.soft);
  if (!outline.scene.rows.of.empty())
    made.own = std::make_shared<const OwnContacts>(scenario, outline.rows);
  if (outline.scene.box) {
    Box& box = *outline.scene.box;
    const auto make = [&](const char* surface, auto& hard, auto& soft) {
      make_surface(scenario, outline.classes, surface, makers, hard, soft);
    };
    make("floor", box.on_floor, made.soft_box.on_floor);
    make("wall", box.on_wall, made.soft_box.on_wall);
    make("lid", box.on_lid, made.soft_box.on_lid);
  }
  make_surfaces(scenario, outline, makers, outline.scene, made.soft_surfaces);
  warn_of_hidden(scenario, outline.scene.has_substrate, made.warnings);
  for (const ContactMaker& maker : makers.all()) {
    for (std::string& warning : contact_warnings(scenario, outline, maker))
      made.warnings.push_back(std::move(warning));
  }
  made.hard = std::move(outline.scene);
  return made;
}

}  // namespace slipcheck
