#include "renderer/pipeline.h"
