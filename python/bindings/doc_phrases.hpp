// Phrases that several docstrings share. Literals, as only these are joined when compiled.
#pragma once

#define SALTUS_RETURNS_BUILDER "Returns\n-------\nModelBuilder\n    The builder itself.\n"

/// Of an actuator.
#define SALTUS_NAME_AND_JOINT "name : str\njoint : str\n    Of one coordinate.\n"
