import { ActionIcon, Button, Menu, Modal, NumberInput, SegmentedControl, Select, TextInput, createTheme } from "@mantine/core";

const TALL = { minHeight: 44 };

/** Dialogs keep clear of the stop button, which stays above them. */
const STOP_BAR = 84;

/** Sizes for gloved fingers: nothing to press is lower than 44 px. Colours stand in tokens.css. */
export const theme = createTheme({
  primaryColor: "green",
  cursorType: "pointer",
  components: {
    Button: Button.extend({ defaultProps: { size: "md" }, styles: { root: { minHeight: 44 } } }),
    ActionIcon: ActionIcon.extend({ defaultProps: { size: 44, variant: "default" } }),
    TextInput: TextInput.extend({ defaultProps: { size: "md" }, styles: { input: TALL } }),
    NumberInput: NumberInput.extend({ defaultProps: { size: "md" }, styles: { input: TALL } }),
    Select: Select.extend({ defaultProps: { size: "md", allowDeselect: false } }),
    SegmentedControl: SegmentedControl.extend({ defaultProps: { size: "md" }, styles: { label: { minHeight: 44, minWidth: 44, alignContent: "center", paddingInline: 5, fontSize: 15 } } }),
    Menu: Menu.extend({ styles: { item: { minHeight: 44, fontSize: 16 } } }),
    // Locking the page's scroll would inject a style element, which the CSP forbids.
    Modal: Modal.extend({ defaultProps: { centered: true, yOffset: STOP_BAR, lockScroll: false, size: "lg", closeButtonProps: { size: 44, "aria-label": "Close" } } }),
  },
});
