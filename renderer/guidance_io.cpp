#include "renderer/guidance_io.h"
