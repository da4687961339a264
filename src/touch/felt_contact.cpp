#include "touch/felt_contact.h"

#include <cstddef>

#include "proxy/contact_parts.h"

namespace hl {

namespace {

FeltContact placeOf(const SceneAt& scene, const ProxyContact& contact) {
  const Instance& instance = scene.instance(contact.primitive);
  const Shape& shape = scene.shape(contact.primitive);
  FeltContact felt;
  felt.session = instance.session;
  felt.object = instance.object;
  felt.name = instance.name;
  felt.item = instance.item;
  felt.point_W = contact.point;
  if (shape.source) return felt;  // a surface that is no mesh has no vertices
  const Primitive& primitive = scene.primitive(contact.primitive);
  felt.kind = shape.primitives.elementKind(contact.primitive.element);
  felt.primitive = shape.primitives.source(contact.primitive.element);
  felt.vertices = verticesOf(shape, contact.primitive.element);
  for (std::size_t i = 0; i < 3; ++i) felt.weights[primitive.order[i]] += contact.weights[i];
  return felt;
}

}  // namespace

FeltContacts feltContacts(const SceneAt& scene, const ProxySettings& settings, const ProxyState& state,
                          const TickReport& report, const Vec3& finger) {
  FeltContacts felt;
  const ContactParts forces_N = contactForces_N(settings, state, report, finger);
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    FeltContact contact = placeOf(scene, report.contacts[i]);
    contact.force_N = forces_N[i];
    felt.push(contact);
  }
  return felt;
}

FeltContacts sharing(const FeltContacts& contacts, const Vec3& held_N, const Vec3& force_N) {
  FeltContacts felt = contacts;
  double sum_N = held_N.norm();
  Vec3 rest_N = force_N - held_N;
  for (const FeltContact& contact : felt) {
    sum_N += contact.force_N.norm();
    rest_N -= contact.force_N;
  }
  for (FeltContact& contact : felt) {
    const double share = sum_N > 0 ? contact.force_N.norm() / sum_N : 1.0 / static_cast<double>(felt.size());
    contact.force_N += share * rest_N;
  }
  return felt;
}

}  // namespace hl
