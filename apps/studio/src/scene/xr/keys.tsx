import { Container, Text } from "@react-three/uikit";

/** Capitals of 32 px are 23 mm high on panels that stand in the room, where a pixel is 1 mm. */
export const WORDS_PX = 32;
const ACCENT = "#3fb8b3";
const ON_ACCENT = "#04211f";

export function Row({ children }: { readonly children: React.ReactNode }) {
  return (
    <Container flexDirection="row" gap={12}>
      {children}
    </Container>
  );
}

export interface KeyProps {
  readonly id: string;
  readonly words: string;
  readonly onPress: () => void;
  readonly color?: string;
  readonly ink?: string;
  /** Of the accent colour: the one that is chosen, or the first thing to do. */
  readonly strong?: boolean;
  /** Acts when pressed; others act when let go, so that a finger can slide off. */
  readonly atOnce?: boolean;
  readonly height?: number;
  readonly size?: number;
  /** Its share of a row is its own width. */
  readonly narrow?: number;
}

export function Key({
  id,
  words,
  onPress,
  strong = false,
  color = strong ? ACCENT : "#2b343a",
  ink = strong ? ON_ACCENT : "#f2f6f8",
  atOnce = false,
  height = 84,
  size = WORDS_PX,
  narrow,
}: KeyProps) {
  return (
    <Container
      id={id}
      flexGrow={narrow === undefined ? 1 : 0}
      flexBasis={narrow ?? 0}
      height={height}
      borderRadius={14}
      alignItems="center"
      justifyContent="center"
      backgroundColor={color}
      borderWidth={4}
      borderColor={color}
      hover={{ borderColor: "#f2f6f8" }}
      active={{ transformTranslateZ: -6 }}
      {...(atOnce ? { onPointerDown: onPress } : { onClick: onPress })}
    >
      <Text fontSize={size} fontWeight="medium" color={ink}>
        {words}
      </Text>
    </Container>
  );
}
