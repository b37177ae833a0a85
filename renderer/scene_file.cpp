#include "renderer/scene_file.h"
