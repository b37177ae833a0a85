#include "renderer/image_io.h"
