# The first of several builds of a Vulkan driver that draws differently from the oldest, or crashes.
raingauge bisect --good builds/1 --bad builds/5 builds/* --run 'raingauge gate --pictures --cells cells.txt \
  "vulkan@VK_DRIVER_FILES=$RG_GOOD/icd.json" "vulkan@VK_DRIVER_FILES=$RG_CANDIDATE/icd.json"'
