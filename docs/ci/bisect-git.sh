# The first commit since `good` whose driver draws differently from the installed one, or crashes.
git bisect start HEAD good
git bisect run raingauge bisect --run "make || exit 125
  raingauge gate --pictures --cells cells.txt vulkan 'vulkan@VK_DRIVER_FILES=icd.json'"
