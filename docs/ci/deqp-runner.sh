# deqp-runner's program for googletest's protocol: it lists the cases, runs them in groups and several at once, and holds the
# results against those of an earlier run. Times would disturb each other, so that pictures alone are compared.
gtest-runner run --bin "$(command -v raingauge)" --output results --jobs 2 --timeout 600 --baseline failures.csv \
  -- gate cpu "vulkan@VK_DRIVER_FILES=$NEW" --require vulkan --pictures --cells cells.txt
