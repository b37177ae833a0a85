#pragma once

#include <glm/vec3.hpp>

#include "texture/strokes/parcels.h"

namespace belvedere {

// Colour factor of fields on the valley floor: crops, darker borders, pale lanes. Meadow replaces
// them towards the slopes; far fields merge into bands. `metres_per_unit`: metres of ground in a
// unit of the sheet (0: unknown, fields stay separate), `air`: share of air in front of them,
// `drift`: AirParameters::hue_drift, 0…3; 0 leaves the colour unchanged.
glm::vec3 field_colour(const Parcel& parcel, float slope_deg, float metres_per_unit, float air,
                       float drift);

}  // namespace belvedere
