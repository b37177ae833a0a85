#pragma once

#include <glm/vec3.hpp>

#include "texture/strokes/parcels.h"

namespace belvedere {

// Factor of the fields on the colour of the valley floor: crops, darker borders, pale lanes. Towards the slopes meadow takes over, far away
// fields melt into bands. `metres_per_unit` is what a unit of the sheet shows (0: unknown, fields stand apart), `air` the share of air
// before them, `drift` AirParameters::hue_drift, 0…3: 0 leaves the colour alone.
glm::vec3 field_colour(const Parcel& parcel, float slope_deg, float metres_per_unit, float air, float drift);

}  // namespace belvedere
