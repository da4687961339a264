// The objects that a model is made of (Model::parts), each as a model of its own.
#pragma once

#include <vector>

#include "scene/model.h"

namespace hl {

/// Throws hl::Error unless the parts of the model, if it has any, fill its lists one after the other, and each uses no
/// vertices but its own.
void checkParts(const Model& model);

/// Makes one object of its parts; their colours become its appearance.
void asOneObject(Model& model);

/// One for each part, in their order; the model is one that checkParts() accepts and has parts. Warnings and what is
/// reported of the reading go with the first.
std::vector<Model> splitModel(Model whole);

}  // namespace hl
