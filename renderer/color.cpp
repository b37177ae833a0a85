#include "renderer/color.h"
