#include "renderer/light.h"
