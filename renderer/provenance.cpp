#include "renderer/provenance.h"
